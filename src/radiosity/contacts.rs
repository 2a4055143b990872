//! Light from what is close: the radiosity of a patch is one value, but a corner sees no more of it than its edge.
//!
//! Once light at vertices is known, the elements close to a place reflect what their own vertices receive, at the point that
//! is nearest, in place of the mean of their patch. Corners darken towards the edge as they should, and neighbours along it
//! see the same whether they touch an element with a corner or with a side.

use glam::Vec3;
use rayon::prelude::*;

use super::field::Field;
use super::reconstruct::fill_hidden;
use crate::base::ids::ElementId;
use crate::base::triangle::{barycentric, closest_point};
use crate::form_factor::Row;
use crate::patch::PatchMesh;

/// Smallest part of a form factor that is worth correcting.
const NEGLIGIBLE: f32 = 5e-3;

/// What the places gathered at see close by.
pub struct Contacts<'a> {
    mesh: &'a PatchMesh,
    /// Reflected radiosity `[e][g]` that was gathered.
    radiosity: &'a Field,
    /// How far is close, metres.
    reach: f32,
    /// Irradiance `[l][g]` at light vertices, and those that lie in the open; none before the first gathering.
    light: Option<(Field, Vec<bool>)>,
}

/// An element close to a place, and the part of its form factor that closeness makes up for.
pub type Contact = (ElementId, f32);

impl<'a> Contacts<'a> {
    /// No light is known yet.
    #[must_use]
    pub fn new(mesh: &'a PatchMesh, radiosity: &'a Field, reach: f32) -> Self {
        Self { mesh, radiosity, reach, light: None }
    }

    /// From now on elements reflect the irradiance `[l][g]` at light vertices. Those that are not valid are in or behind
    /// something and receive what those next to them do.
    pub fn learn(&mut self, direct: &Field, indirect: &Field, is_valid: &[bool]) {
        let (mut direct, mut indirect) = (direct.clone(), indirect.clone());
        fill_hidden(self.mesh, is_valid, [&mut direct, &mut indirect]);
        direct.values_mut().par_iter_mut().zip(indirect.values()).for_each(|(sum, &value)| *sum += value);
        self.light = Some((direct, is_valid.to_vec()));
    }

    /// Elements in a row that are close to a place, and the distance of the nearest point on any surface in it.
    #[must_use]
    pub fn of(&self, row: &Row, place: Vec3) -> (Vec<Contact>, f32) {
        let (mut contacts, mut nearest) = (Vec::new(), f32::MAX);
        // Exact where it may count, else infinite.
        let mut distance_of = |element: ElementId| {
            let corners = self.mesh.corners(&self.mesh.elements[element.index()]);
            let size = corners[0].distance(corners[1]).max(corners[0].distance(corners[2]));
            let may_count = corners[0].distance(place) - size < nearest.max(self.reach);
            let distance = if may_count { closest_point(corners, place).distance(place) } else { f32::INFINITY };
            nearest = nearest.min(distance);
            distance
        };
        for entry in &row.entries {
            let part = entry.factor * (1.0 - distance_of(entry.element) / self.reach);
            if part > NEGLIGIBLE {
                contacts.push((entry.element, part));
            }
        }
        row.backs.iter().for_each(|entry| _ = distance_of(entry.element));
        (contacts, nearest)
    }

    /// Corrects the irradiance `[g]` gathered at a place by what its contacts reflect there.
    pub fn correct(&self, contacts: &[Contact], place: Vec3, irradiance: &mut [Vec3]) {
        let Some((light, is_valid)) = &self.light else { return };
        for &(e, part) in contacts {
            let element = &self.mesh.elements[e.index()];
            let vertices = self.mesh.light_vertices_of(element);
            if !vertices.iter().any(|&l| is_valid[l]) {
                continue;
            }
            let corners = self.mesh.corners(element);
            let weights = barycentric(corners, closest_point(corners, place)).to_array();
            for (g, sum) in irradiance.iter_mut().enumerate() {
                let received: Vec3 = (0..3).map(|k| weights[k] * light.at(vertices[k])[g]).sum();
                *sum += part * (element.reflectance * received - self.radiosity.at(e.index())[g]);
            }
        }
    }
}
