//! A scene with its solved light: the input of everything that is computed after a bake.

use std::sync::Arc;

use glam::Vec3;

use crate::bake::{Bake, BakeSettings, Quality, Report};
use crate::bake::{MeasureContext, MeasureSettings, Measured, measure_with};
use crate::baked::BakedScene;
use crate::base::progress::Progress;
use crate::patch::{MeshError, MeshSettings, PatchMesh};
use crate::radiosity::Field;
use crate::raytrace::MeasuringPoint;
use crate::scene::Scene;
use crate::viewer::settings::light::GroupDial;

/// A scene with its solved light.
pub struct SolvedScene {
    /// The scene before the bake, or its elements if the file is a bake.
    pub scene: Arc<Scene>,
    /// The elements: triangle `e` of `baked` is element `e`.
    pub mesh: PatchMesh,
    /// The elements with their light.
    pub baked: BakedScene,
    /// Precision of measurements.
    pub quality: Quality,
    /// The report of the bake; `None` if the file is a bake.
    pub report: Option<Report>,
}

impl SolvedScene {
    /// Wraps the result of a bake of `scene`.
    #[must_use]
    pub fn of_bake(scene: Arc<Scene>, bake: Bake, settings: &BakeSettings) -> Self {
        let Bake { baked, report, mesh } = bake;
        Self { scene, mesh, baked, quality: settings.quality, report: Some(report) }
    }

    /// Wraps a bake that was loaded from a file.
    ///
    /// # Errors
    /// Returns an error if it has no elements.
    pub fn of_file(baked: BakedScene) -> Result<Self, MeshError> {
        // The triangles are the elements: they are not subdivided again.
        let mesh = PatchMesh::new(&baked.scene, &MeshSettings::uncut())?;
        let scene = Arc::new(baked.scene.clone());
        Ok(Self { scene, mesh, baked, quality: Quality::default(), report: None })
    }

    /// Measures as `hemicube measure` does; `None` if it was cancelled.
    #[must_use]
    pub fn measure(&self, points: &[MeasuringPoint], progress: &dyn Progress) -> Option<Vec<Measured>> {
        let settings = MeasureSettings::preset(self.quality);
        let context = MeasureContext { scene: &self.scene, mesh: &self.mesh, baked: &self.baked, progress };
        measure_with(&context, points, &settings)
    }

    /// Computes the direct irradiance `[e][g]` of the elements, the mean of their corners, lux per channel.
    #[must_use]
    pub fn direct_on_elements(&self) -> Field {
        let groups = &self.baked.light.groups;
        let of_element = |triangle: &crate::scene::Triangle| {
            let corners = triangle.vertices.map(|v| v as usize);
            groups.iter().map(move |group| corners.map(|v| group.direct[v]).iter().sum::<Vec3>() / 3.0)
        };
        Field::from_values(groups.len(), self.baked.scene.triangles.iter().flat_map(of_element).collect())
    }

    /// Returns the bake with the stored light and the light sources of each group multiplied by the weight of its dial.
    #[must_use]
    pub fn dimmed(&self, dials: &[GroupDial]) -> BakedScene {
        let mut baked = self.baked.clone();
        let weight = |group: usize| dials.get(group).map_or(Vec3::ONE, GroupDial::weight);
        for (g, light) in baked.light.groups.iter_mut().enumerate() {
            light.direct.iter_mut().chain(&mut light.indirect).for_each(|value| *value *= weight(g));
        }
        for material in &mut baked.scene.materials {
            if let Some(group) = material.group {
                material.emission *= weight(group.index());
            }
        }
        for light in &mut baked.scene.lights {
            light.intensity *= weight(light.group.index());
        }
        baked
    }
}
