//! Reconstruction: transfers irradiance from light vertices or elements to the mesh that is drawn.

use glam::Vec3;

use super::field::Field;
use crate::baked::{GroupLight, VertexLight};
use crate::patch::PatchMesh;

/// Copies light at light vertices `[l][g]` to the vertices `[v]` of the drawn mesh.
#[must_use]
pub fn vertex_light(mesh: &PatchMesh, direct: &Field, indirect: &Field) -> VertexLight {
    let of_group = |field: &Field, g: usize| mesh.light_vertex_of.iter().map(|&l| field.at(l as usize)[g]).collect();
    let groups = (0..direct.num_groups())
        .map(|g| GroupLight { direct: of_group(direct, g), indirect: of_group(indirect, g) })
        .collect();
    VertexLight { groups }
}

/// Returns the mean over the elements around each light vertex `[l][g]`, weighted by area.
#[must_use]
pub fn average(mesh: &PatchMesh, on_elements: &Field) -> Field {
    let num_groups = on_elements.num_groups();
    let mut sums = Field::zero(mesh.light_vertices.len(), num_groups);
    let mut weights = vec![0.0f32; mesh.light_vertices.len()];
    for (e, element) in mesh.elements.iter().enumerate() {
        for l in mesh.light_vertices_of(element) {
            weights[l] += element.area;
            for (sum, &value) in sums.at_mut(l).iter_mut().zip(on_elements.at(e)) {
                *sum += value * element.area;
            }
        }
    }
    for (l, weight) in weights.iter().enumerate() {
        for sum in sums.at_mut(l) {
            *sum /= weight.max(f32::MIN_POSITIVE);
        }
    }
    sums
}

/// Replaces the light of vertices inside or behind a solid by the mean of their valid neighbours along the mesh, so
/// that interpolation does not spread their darkness over open surfaces.
///
/// Vertices without a valid neighbour stay unchanged: the elements around them are hidden.
pub fn fill_hidden(mesh: &PatchMesh, is_valid: &[bool], fields: [&mut Field; 2]) {
    let [direct, indirect] = fields;
    let num_groups = direct.num_groups();
    for (l, sums) in neighbour_sums(mesh, is_valid, direct, indirect) {
        for g in 0..num_groups {
            direct.at_mut(l)[g] = sums.values[g] / sums.count;
            indirect.at_mut(l)[g] = sums.values[num_groups + g] / sums.count;
        }
    }
}

/// The sum over valid neighbours: direct light of all groups, then indirect light of all groups.
struct NeighbourSums {
    values: Vec<Vec3>,
    count: f32,
}

fn neighbour_sums(
    mesh: &PatchMesh,
    is_valid: &[bool],
    direct: &Field,
    indirect: &Field,
) -> std::collections::BTreeMap<usize, NeighbourSums> {
    let num_groups = direct.num_groups();
    let mut reached = std::collections::BTreeMap::new();
    for element in &mesh.elements {
        let corners = mesh.light_vertices_of(element);
        for (k, &l) in corners.iter().enumerate() {
            if is_valid[l] {
                continue;
            }
            for neighbour in [corners[(k + 1) % 3], corners[(k + 2) % 3]] {
                if is_valid[neighbour] {
                    let sums = reached
                        .entry(l)
                        .or_insert_with(|| NeighbourSums { values: vec![Vec3::ZERO; 2 * num_groups], count: 0.0 });
                    let known = direct.at(neighbour).iter().chain(indirect.at(neighbour));
                    sums.values.iter_mut().zip(known).for_each(|(sum, &value)| *sum += value);
                    sums.count += 1.0;
                }
            }
        }
    }
    reached
}
