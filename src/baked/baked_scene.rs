//! The result of a bake: elements as a scene, with light at their vertices.

use glam::Vec3;

use super::bisection_trees::BisectionTrees;
use crate::base::ids::TriangleId;
use crate::patch::PatchMesh;
use crate::scene::{Back, Instance, Scene, Sides, Triangle};

/// A scene whose vertices carry light.
#[derive(Clone, Debug, Default)]
pub struct BakedScene {
    /// Elements as triangles, with the pairing of fronts and backs.
    pub scene: Scene,
    /// Light at the vertices of `scene`.
    pub light: VertexLight,
    /// Bisection trees whose leaves are the triangles of `scene`. `None` if they are not known.
    pub trees: Option<BisectionTrees>,
}

/// Irradiance at vertices by light group, with direct and indirect light separate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexLight {
    /// Light of each group `[g]`, in the order of [`Scene::light_groups`].
    pub groups: Vec<GroupLight>,
}

/// Irradiance by one light group, lux per channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroupLight {
    /// Irradiance that arrives directly from lights `[v]`.
    pub direct: Vec<Vec3>,
    /// Irradiance that arrives after at least one reflection `[v]`.
    pub indirect: Vec<Vec3>,
}

impl BakedScene {
    /// Returns a scene with light at its vertices.
    #[must_use]
    pub fn new(scene: Scene, light: VertexLight) -> Self {
        Self { scene, light, trees: None }
    }

    /// Returns a scene without light.
    #[must_use]
    pub fn dark(scene: Scene) -> Self {
        let light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
        Self::new(scene, light)
    }

    /// Returns the elements of a mesh of `scene` as triangles, without light.
    #[must_use]
    pub fn of_mesh(scene: &Scene, mesh: &PatchMesh) -> Self {
        let triangle = |element: &crate::patch::Element| Triangle {
            vertices: element.vertices,
            ..scene.triangles[element.triangle.index()]
        };
        let triangles: Vec<Triangle> = mesh.elements.iter().map(triangle).collect();
        // Elements are in the order of their input triangles, so those of an instance are a range as well.
        let first_element = |t: usize| mesh.roots.get(t).map_or(triangles.len(), |root| root.first_element as usize);
        let instance = |instance: &Instance| Instance {
            name: instance.name.clone(),
            triangles: first_element(instance.triangles.start)..first_element(instance.triangles.end),
        };
        let scene = Scene {
            name: scene.name.clone(),
            vertices: mesh.vertices.clone(),
            sides: sides_of(mesh),
            instances: scene.instances.iter().map(instance).collect(),
            triangles,
            nodes: scene.nodes.clone(),
            materials: scene.materials.clone(),
            textures: scene.textures.clone(),
            lights: scene.lights.clone(),
            cameras: scene.cameras.clone(),
            light_groups: scene.light_groups.clone(),
            irradiance: Vec::new(),
            element_records: Vec::new(),
            notes: scene.notes.clone(),
            variants: Vec::new(),
            dropped_triangles: scene.dropped_triangles,
        };
        Self { trees: Some(BisectionTrees::of_mesh(mesh)), ..Self::dark(scene) }
    }
}

/// Returns the elements that are backs of others.
fn sides_of(mesh: &PatchMesh) -> Sides {
    let double_sided = mesh.roots.iter().filter(|root| root.has_backs);
    let fronts = double_sided.flat_map(|root| {
        (root.first_element..root.first_element + root.num_elements).map(|front| (front, front + root.num_elements))
    });
    let mut sides = Sides::default();
    sides.add_pairs(fronts.map(|(front, back)| (TriangleId(front), Back::flipped(TriangleId(back)))));
    sides
}

impl VertexLight {
    /// Light that is 0 everywhere.
    #[must_use]
    pub fn dark(num_groups: usize, num_vertices: usize) -> Self {
        let group = GroupLight { direct: vec![Vec3::ZERO; num_vertices], indirect: vec![Vec3::ZERO; num_vertices] };
        Self { groups: vec![group; num_groups] }
    }
}
