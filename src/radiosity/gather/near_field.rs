//! Near-field correction of gathered light.
//!
//! The indirect radiosity of a patch is one constant value, but a viewpoint in a corner sees only the edge of the
//! patch. Once irradiance at the vertices is known, an element close to a viewpoint reflects the irradiance
//! interpolated from its own vertices, at its nearest point, instead of the mean of its patch. Corners then darken
//! towards the edge, and viewpoints along an edge receive the same light whether a corner or a side of an element
//! touches them.
//!
//! Source: the error of constant elements near a receiver, Baum, Rushmeier, Winget 1989 (proximity); Wallace, Elmquist,
//! Haines 1989 (radiosity interpolated from vertices).

use glam::Vec3;
use rayon::prelude::*;

use crate::base::ids::ElementId;
use crate::base::triangle::{barycentric, closest_point};
use crate::form_factor::Row;
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;
use crate::radiosity::reconstruction::fill_hidden;

/// Smallest part of a form factor that is corrected.
const NEGLIGIBLE: f32 = 5e-3;

/// Corrects what viewpoints gather from elements close by.
pub(super) struct NearField<'a> {
    mesh: &'a PatchMesh,
    /// Reflected radiosity `[e][g]` as it is gathered without correction.
    radiosity: &'a Field,
    /// Distance beyond which elements are not corrected, metres.
    reach: f32,
    /// Irradiance `[l][g]` at light vertices, and whether each lies in the open; `None` before the first gather.
    light: Option<(Field, Vec<bool>)>,
}

/// An element close to a viewpoint, and the part of its form factor that is corrected: F (1 - distance / reach).
pub(super) type NearElement = (ElementId, f32);

impl<'a> NearField<'a> {
    /// Creates a correction that changes nothing until the light at vertices is set.
    pub fn new(mesh: &'a PatchMesh, radiosity: &'a Field, reach: f32) -> Self {
        Self { mesh, radiosity, reach, light: None }
    }

    /// Sets the irradiance `[l][g]` at light vertices. Vertices that are not valid lie in or behind a solid and take
    /// the light of their neighbours.
    pub fn set_vertex_light(&mut self, direct: &Field, indirect: &Field, is_valid: &[bool]) {
        let (mut direct, mut indirect) = (direct.clone(), indirect.clone());
        fill_hidden(self.mesh, is_valid, [&mut direct, &mut indirect]);
        direct.values_mut().par_iter_mut().zip(indirect.values()).for_each(|(sum, &value)| *sum += value);
        self.light = Some((direct, is_valid.to_vec()));
    }

    /// The elements of a row that are close to `point`, and the distance of the nearest point of any surface in the
    /// row.
    pub fn near_elements(&self, row: &Row, point: Vec3) -> (Vec<NearElement>, f32) {
        let (mut near, mut nearest) = (Vec::new(), f32::MAX);
        // The exact distance if it may matter, else infinity.
        let mut distance_of = |element: ElementId| {
            let corners = self.mesh.corners(&self.mesh.elements[element.index()]);
            let size = corners[0].distance(corners[1]).max(corners[0].distance(corners[2]));
            let may_matter = corners[0].distance(point) - size < nearest.max(self.reach);
            let distance = if may_matter { closest_point(corners, point).distance(point) } else { f32::INFINITY };
            nearest = nearest.min(distance);
            distance
        };
        for entry in &row.entries {
            let part = entry.factor * (1.0 - distance_of(entry.element) / self.reach);
            if part > NEGLIGIBLE {
                near.push((entry.element, part));
            }
        }
        row.backs.iter().for_each(|entry| _ = distance_of(entry.element));
        (near, nearest)
    }

    /// Corrects the irradiance `[g]` gathered at `point` for its near elements.
    ///
    /// Equation: E += sum over near elements of part x (rho_e E_e(nearest point) - B_e).
    pub fn correct(&self, near: &[NearElement], point: Vec3, irradiance: &mut [Vec3]) {
        let Some((light, is_valid)) = &self.light else { return };
        for &(e, part) in near {
            let element = &self.mesh.elements[e.index()];
            let vertices = self.mesh.light_vertices_of(element);
            if !vertices.iter().any(|&l| is_valid[l]) {
                continue;
            }
            let corners = self.mesh.corners(element);
            let weights = barycentric(corners, closest_point(corners, point)).to_array();
            for (g, sum) in irradiance.iter_mut().enumerate() {
                let received: Vec3 = (0..3).map(|k| weights[k] * light.at(vertices[k])[g]).sum();
                *sum += part * (element.reflectance * received - self.radiosity.at(e.index())[g]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::Entry;
    use crate::patch::MeshSettings;
    use crate::scene::{Material, SceneBuilder};

    #[test]
    fn near_elements_reflect_the_light_of_their_vertices_and_far_ones_that_of_their_patch() {
        let mut builder = SceneBuilder::default();
        let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
        builder.room(Vec3::ZERO, Vec3::ONE, [grey; 6]);
        let scene = builder.build();
        let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.3, patch_size: 0.5 }).expect("a small mesh");
        let radiosity = Field::from_values(1, vec![Vec3::ONE; mesh.elements.len()]);
        let received = Field::from_values(1, vec![Vec3::splat(4.0); mesh.light_vertices.len()]);
        let nothing = Field::zero(mesh.light_vertices.len(), 1);
        // Just below the middle of the ceiling, which fills the view: rho x 4 = 2 is reflected there and not 1.
        let (reach, height) = (0.5, 0.1);
        let point = Vec3::new(0.5, 1.0 - height, 0.5);
        let above = mesh.elements.iter().position(|element| {
            let [a, b, c] = mesh.corners(element);
            a.y == 1.0 && b.y == 1.0 && c.y == 1.0 && [a, b, c].iter().any(|p| (p.x, p.z) == (0.5, 0.5))
        });
        let row = |element: usize| Row {
            entries: vec![Entry { element: ElementId::new(element), factor: 1.0 }],
            ..Row::default()
        };
        let mut near_field = NearField::new(&mesh, &radiosity, reach);
        let (near, nearest) = near_field.near_elements(&row(above.expect("the ceiling")), point);
        assert!((nearest - height).abs() < 1e-6, "{nearest}");
        let corrected = |near_field: &NearField<'_>| {
            let mut irradiance = [Vec3::ONE];
            near_field.correct(&near, point, &mut irradiance);
            irradiance[0].x
        };
        assert_eq!(corrected(&near_field), 1.0);
        near_field.set_vertex_light(&received, &nothing, &vec![true; mesh.light_vertices.len()]);
        let expected = 1.0 + (1.0 - height / reach);
        assert!((corrected(&near_field) - expected).abs() < 1e-5, "{} for {expected}", corrected(&near_field));
        // The floor is beyond the reach of the near field.
        let floor = mesh.elements.iter().position(|element| mesh.corners(element).iter().all(|p| p.y == 0.0));
        assert!(near_field.near_elements(&row(floor.expect("the floor")), point).0.is_empty());
    }
}
