//! Where irradiance is looked up: the light vertices, each moved a hair off its surface.

use glam::Vec3;
use rayon::prelude::*;

use crate::base::ids::ElementId;
use crate::base::sampling::{hash, r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::form_factor::Viewpoint;
use crate::patch::{Element, LightVertex, Patch, PatchMesh};
use crate::scene::{Scene, normal_of};

/// Height of a viewpoint above its surface, as a share of the scene's extent: far above rounding, far below detail.
const HEIGHT: f32 = 2e-5;

/// How far a site is moved from its vertex towards the middle of the elements round it. A vertex in a corner of the room
/// lies exactly in the other wall; a site must not.
const INSET: f32 = 0.05;

/// Smallest cosine between a shading normal and that of an element for the one to tell what is above the other.
const STEEPEST: f32 = 0.1;

/// Makes viewpoints that stand off their surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Sites {
    height: f32,
}

impl Sites {
    /// Sites for a scene of its size.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self { height: HEIGHT * scene.bounds().extent() }
    }

    /// One viewpoint a light vertex `[l]`, with its shading normal.
    #[must_use]
    pub fn of_light_vertices(&self, mesh: &PatchMesh) -> Vec<Viewpoint> {
        let corner = |e: usize| mesh.light_vertices_of(&mesh.elements[e]).map(|l| (l as u32, ElementId::new(e)));
        let mut corners: Vec<(u32, ElementId)> = (0..mesh.elements.len()).flat_map(corner).collect();
        corners.par_sort_unstable_by_key(|&(l, e)| (l, e.0));
        let mut corners = corners.as_slice();
        let mut site = |(l, vertex): (usize, &LightVertex)| {
            let (round, rest) = corners.split_at(corners.partition_point(|&(of, _)| of == l as u32));
            corners = rest;
            self.beside(mesh, vertex, round.iter().map(|&(_, e)| e), l as u32)
        };
        mesh.light_vertices.iter().enumerate().map(&mut site).collect()
    }

    /// The viewpoint of a light vertex: a little towards the middle of the elements round it, and above all of them.
    #[must_use]
    pub fn beside(
        &self,
        mesh: &PatchMesh,
        vertex: &LightVertex,
        round: impl Iterator<Item = ElementId> + Clone,
        seed: u32,
    ) -> Viewpoint {
        let elements = || round.clone().map(|e| &mesh.elements[e.index()]);
        let num_elements = elements().count().max(1) as f32;
        let to_middle = elements().map(|element| mesh.centroid(element) - vertex.position).sum::<Vec3>() / num_elements;
        // Only sideways: on a curved surface the middle lies below the tangent plane.
        let sideways = INSET * to_middle.reject_from(vertex.normal);
        // A shading normal may lean away from the surface: what went sideways is then below it.
        let depth = |element: &Element| {
            let normal = normal_of(mesh.corners(element));
            let cosine = normal.dot(vertex.normal);
            if cosine > STEEPEST { -sideways.dot(normal) / cosine } else { 0.0 }
        };
        let lift = elements().map(depth).fold(0.0, f32::max);
        self.viewpoint(vertex.position + sideways + lift * vertex.normal, vertex.normal, seed)
    }

    /// `num_points` viewpoints on each element, side by side, with its geometric normal.
    #[must_use]
    pub fn of_elements(&self, mesh: &PatchMesh, num_points: usize) -> Vec<Viewpoint> {
        let on_element = |(e, element): (usize, &Element)| {
            let corners = mesh.corners(element);
            let normal = normal_of(corners);
            (0..num_points as u32).map(move |i| {
                let weights = triangle_from_square(r2(i, e as u32));
                let position = interpolate(corners, weights);
                self.viewpoint(position, normal, hash(e as u32) ^ i)
            })
        };
        mesh.elements.iter().enumerate().flat_map(on_element).collect()
    }

    /// `num_points` viewpoints spread over a patch by area.
    #[must_use]
    pub fn of_patch(&self, mesh: &PatchMesh, patch: &Patch, num_points: usize) -> Vec<Viewpoint> {
        let members = mesh.members_of(patch);
        if num_points == 1 {
            let central = most_central(mesh, members);
            let element = &mesh.elements[central.index()];
            return vec![self.viewpoint(mesh.centroid(element), normal_of(mesh.corners(element)), central.0)];
        }
        (0..num_points as u32)
            .map(|i| {
                let stratum = patch.area * (i as f32 + 0.5) / num_points as f32;
                let element = at_area(mesh, members, stratum);
                let corners = mesh.corners(&mesh.elements[element.index()]);
                let seed = hash(element.0) ^ i;
                let weights = triangle_from_square(r2(i, element.0));
                let position = interpolate(corners, weights);
                self.viewpoint(position, normal_of(corners), seed)
            })
            .collect()
    }

    /// A viewpoint just above a place on a surface.
    #[must_use]
    pub fn viewpoint(&self, position: Vec3, normal: Vec3, seed: u32) -> Viewpoint {
        Viewpoint { position: position + normal * self.height, normal, seed }
    }
}

/// The element nearest to the mean centroid.
fn most_central(mesh: &PatchMesh, members: &[ElementId]) -> ElementId {
    let centroid = |e: &ElementId| mesh.centroid(&mesh.elements[e.index()]);
    let mean = members.iter().map(centroid).sum::<Vec3>() / members.len() as f32;
    *members
        .iter()
        .min_by(|a, b| centroid(a).distance_squared(mean).total_cmp(&centroid(b).distance_squared(mean)))
        .expect("a patch has members")
}

/// The element in which the running sum of areas passes `area`.
fn at_area(mesh: &PatchMesh, members: &[ElementId], area: f32) -> ElementId {
    let mut sum = 0.0;
    for &element in members {
        sum += mesh.elements[element.index()].area;
        if sum >= area {
            return element;
        }
    }
    *members.last().expect("a patch has members")
}
