//! What shadows ask of a scene beyond its buffers.

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use glam::Vec4;
use wgpu::util::DeviceExt;

use super::casters::Casters;
use super::cutout_shadow::Cutouts;
use super::exact_rays::ExactRays;
use super::light_samples::{LightSample, light_samples};
use super::map_cache::MapCache;
use crate::base::bounds::Bounds;
use crate::gpu::Gpu;
use crate::scene::Scene;

/// What shadows ask of a scene beyond its buffers.
pub struct ShadowScene {
    scene: Arc<Scene>,
    bounds: Bounds,
    /// Triangles that throw shadows.
    pub(super) casters: Casters,
    /// Each corner of the casters twice, as `silhouette::Hull` counts them.
    pub(super) corners: wgpu::Buffer,
    /// Casters with holes.
    pub(super) cutouts: Vec<Cutouts>,
    /// Built when the truth is first asked for.
    rays: OnceLock<ExactRays>,
    maps: Mutex<MapCache>,
    /// Those that were asked for last.
    samples: Mutex<Option<KeptSamples>>,
}

/// Light samples, and from what they were made.
struct KeptSamples {
    per_lamp: u32,
    radius: f32,
    samples: Arc<[LightSample]>,
}

impl ShadowScene {
    /// Prepares a scene that has been uploaded, with the same triangles.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: Arc<Scene>) -> Self {
        let casters = Casters::new(&scene);
        let corners: Vec<Vec4> = casters.positions.iter().flat_map(|p| [0.0, 1.0].map(|w| p.extend(w))).collect();
        let corners = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("corners of casters"),
            contents: bytemuck::cast_slice(&corners),
            usage: wgpu::BufferUsages::VERTEX,
        });
        Self {
            cutouts: Cutouts::of_scene(gpu, &scene),
            bounds: scene.bounds(),
            scene,
            casters,
            corners,
            rays: OnceLock::new(),
            maps: Mutex::default(),
            samples: Mutex::default(),
        }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The box round it.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Triangles that throw shadows.
    #[must_use]
    pub fn casters(&self) -> &Casters {
        &self.casters
    }

    /// Its lights as [`light_samples`] are, kept until others are asked for: whatever its size, a picture needs them.
    pub(super) fn light_samples(&self, per_lamp: u32, radius: f32) -> Arc<[LightSample]> {
        let mut kept = self.samples.lock().unwrap_or_else(PoisonError::into_inner);
        let same = kept.as_ref().filter(|kept| (kept.per_lamp, kept.radius) == (per_lamp, radius));
        if let Some(same) = same {
            return Arc::clone(&same.samples);
        }
        let samples: Arc<[_]> = light_samples(&self.scene, per_lamp, radius).into();
        *kept = Some(KeptSamples { per_lamp, radius, samples: Arc::clone(&samples) });
        samples
    }

    /// A picture has been drawn: lets go of what pictures no longer need.
    pub fn forget_unused(&self) {
        self.maps().forget_unused();
    }

    /// Shadow maps of its lights.
    pub(super) fn maps(&self) -> MutexGuard<'_, MapCache> {
        self.maps.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lines of sight through it.
    pub(super) fn rays(&self) -> &ExactRays {
        self.rays.get_or_init(|| ExactRays::new(Arc::clone(&self.scene)))
    }
}
