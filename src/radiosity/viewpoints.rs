//! Viewpoints on a mesh: points slightly above its patches, elements and light vertices, at which form factors and
//! direct light are sampled.

use glam::Vec3;
use rayon::prelude::*;

use crate::base::ids::ElementId;
use crate::base::sampling::{hash, r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::form_factor::Viewpoint;
use crate::patch::{Element, LightVertex, Patch, PatchMesh};
use crate::scene::{Scene, normal_of};

/// Height of a viewpoint above its surface, as a share of the scene's extent: well above rounding errors, well below
/// detail.
const HEIGHT: f32 = 2e-5;

/// A viewpoint is moved by this share of the way from its vertex to the middle of the elements around the vertex. A
/// vertex in a corner of a room lies exactly in the other wall, but its viewpoint must not.
const INSET: f32 = 0.05;

/// Smallest cosine between a shading normal and the normal of an element at which the viewpoint is lifted above the
/// element.
const MIN_COSINE: f32 = 0.1;

/// Places viewpoints at a fixed height above the surfaces of one scene.
#[derive(Clone, Copy, Debug)]
pub struct Viewpoints {
    height: f32,
}

impl Viewpoints {
    /// Derives the height from the extent of the scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self { height: HEIGHT * scene.bounds().extent() }
    }

    /// One viewpoint per light vertex `[l]`, with its shading normal.
    #[must_use]
    pub fn at_light_vertices(&self, mesh: &PatchMesh) -> Vec<Viewpoint> {
        let corner = |e: usize| mesh.light_vertices_of(&mesh.elements[e]).map(|l| (l as u32, ElementId::new(e)));
        let mut corners: Vec<(u32, ElementId)> = (0..mesh.elements.len()).flat_map(corner).collect();
        corners.par_sort_unstable_by_key(|&(l, e)| (l, e.0));
        let mut corners = corners.as_slice();
        let mut viewpoint = |(l, vertex): (usize, &LightVertex)| {
            let (around, rest) = corners.split_at(corners.partition_point(|&(of, _)| of == l as u32));
            corners = rest;
            self.at_vertex(mesh, vertex, around.iter().map(|&(_, e)| e), l as u32)
        };
        mesh.light_vertices.iter().enumerate().map(&mut viewpoint).collect()
    }

    /// Returns the viewpoint of a light vertex, moved slightly towards the middle of the elements `around` it, and
    /// above all of them.
    #[must_use]
    pub fn at_vertex(
        &self,
        mesh: &PatchMesh,
        vertex: &LightVertex,
        around: impl Iterator<Item = ElementId> + Clone,
        seed: u32,
    ) -> Viewpoint {
        let elements = || around.clone().map(|e| &mesh.elements[e.index()]);
        let num_elements = elements().count().max(1) as f32;
        let to_middle = elements().map(|element| mesh.centroid(element) - vertex.position).sum::<Vec3>() / num_elements;
        // The offset lies in the tangent plane, because on a curved surface the middle lies below it.
        let offset = INSET * to_middle.reject_from(vertex.normal);
        // If the shading normal leans away from the surface, the moved point lies below the surface.
        let depth = |element: &Element| {
            let normal = normal_of(mesh.corners(element));
            let cosine = normal.dot(vertex.normal);
            if cosine > MIN_COSINE { -offset.dot(normal) / cosine } else { 0.0 }
        };
        let lift = elements().map(depth).fold(0.0, f32::max);
        self.above(vertex.position + offset + lift * vertex.normal, vertex.normal, seed)
    }

    /// `num_points` viewpoints on each element, element by element, with its geometric normal.
    #[must_use]
    pub fn on_elements(&self, mesh: &PatchMesh, num_points: usize) -> Vec<Viewpoint> {
        let on_element = |(e, element): (usize, &Element)| {
            let corners = mesh.corners(element);
            let normal = normal_of(corners);
            (0..num_points as u32).map(move |i| {
                let weights = triangle_from_square(r2(i, e as u32));
                let position = interpolate(corners, weights);
                self.above(position, normal, hash(e as u32) ^ i)
            })
        };
        mesh.elements.iter().enumerate().flat_map(on_element).collect()
    }

    /// `num_points` viewpoints on a patch, spread by area; a single one lies on its most central element.
    #[must_use]
    pub fn on_patch(&self, mesh: &PatchMesh, patch: &Patch, num_points: usize) -> Vec<Viewpoint> {
        let members = mesh.members_of(patch);
        if num_points == 1 {
            let central = most_central(mesh, members);
            let element = &mesh.elements[central.index()];
            return vec![self.above(mesh.centroid(element), normal_of(mesh.corners(element)), central.0)];
        }
        (0..num_points as u32)
            .map(|i| {
                let stratum = patch.area * (i as f32 + 0.5) / num_points as f32;
                let element = at_area(mesh, members, stratum);
                let corners = mesh.corners(&mesh.elements[element.index()]);
                let seed = hash(element.0) ^ i;
                let weights = triangle_from_square(r2(i, element.0));
                let position = interpolate(corners, weights);
                self.above(position, normal_of(corners), seed)
            })
            .collect()
    }

    /// Returns the viewpoint above a point on a surface.
    #[must_use]
    pub fn above(&self, position: Vec3, normal: Vec3, seed: u32) -> Viewpoint {
        Viewpoint { position: position + normal * self.height, normal, seed }
    }
}

/// Returns the element nearest to the mean centroid.
fn most_central(mesh: &PatchMesh, members: &[ElementId]) -> ElementId {
    let centroid = |e: &ElementId| mesh.centroid(&mesh.elements[e.index()]);
    let mean = members.iter().map(centroid).sum::<Vec3>() / members.len() as f32;
    *members
        .iter()
        .min_by(|a, b| centroid(a).distance_squared(mean).total_cmp(&centroid(b).distance_squared(mean)))
        .expect("a patch has members")
}

/// Returns the element at which the running sum of areas reaches `area`.
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
