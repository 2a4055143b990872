//! Where irradiance is looked up: the light vertices, each moved a hair off its surface.

use glam::Vec3;

use crate::base::ids::ElementId;
use crate::base::sampling::{hash, r2, triangle_from_square};
use crate::form_factor::Viewpoint;
use crate::patch::{Element, LightVertex, Patch, PatchMesh};
use crate::scene::{Scene, normal_of};

/// Height of a viewpoint above its surface, as a share of the scene's extent: far above rounding, far below detail.
const HEIGHT: f32 = 2e-5;

/// How far a site is moved from its vertex towards the middle of the elements round it. A vertex in a corner of the room
/// lies exactly in the other wall; a site must not.
const INSET: f32 = 0.05;

/// Makes viewpoints that stand off their surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Sites {
    height: f32,
}

impl Sites {
    /// Sites for a scene of its size.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let (low, high) = scene.bounds();
        Self { height: HEIGHT * (high - low).max_element() }
    }

    /// One viewpoint a light vertex `[l]`, with its shading normal.
    #[must_use]
    pub fn of_light_vertices(&self, mesh: &PatchMesh) -> Vec<Viewpoint> {
        let mut sum_of_centroids = vec![(Vec3::ZERO, 0.0); mesh.light_vertices.len()];
        for element in &mesh.elements {
            let centroid = mesh.centroid(element);
            for l in mesh.light_vertices_of(element) {
                sum_of_centroids[l].0 += centroid;
                sum_of_centroids[l].1 += 1.0;
            }
        }
        let site = |(l, (sum, count)): (usize, &(Vec3, f32))| {
            let vertex = &mesh.light_vertices[l];
            let middle = if *count > 0.0 { sum / *count } else { vertex.position };
            self.beside(vertex, middle, l as u32)
        };
        sum_of_centroids.iter().enumerate().map(site).collect()
    }

    /// The viewpoint of a light vertex, a little towards the middle of the elements round it.
    #[must_use]
    pub fn beside(&self, vertex: &LightVertex, middle: Vec3, seed: u32) -> Viewpoint {
        // Only sideways: on a curved surface the middle lies below the tangent plane.
        let sideways = (middle - vertex.position).reject_from(vertex.normal);
        self.viewpoint(vertex.position + INSET * sideways, vertex.normal, seed)
    }

    /// `num_points` viewpoints on each element, side by side, with its geometric normal.
    #[must_use]
    pub fn of_elements(&self, mesh: &PatchMesh, num_points: usize) -> Vec<Viewpoint> {
        let on_element = |(e, element): (usize, &Element)| {
            let corners = mesh.corners(element);
            let normal = normal_of(corners);
            (0..num_points as u32).map(move |i| {
                let weights = triangle_from_square(r2(i, e as u32));
                let position = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
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
                let position = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
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
