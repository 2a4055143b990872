//! Data of a scene for shadows: its casters, lines of sight through it, and data that techniques cache with it.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use super::casters::Casters;
use super::exact_rays::ExactRays;
use crate::base::bounds::Bounds;
use crate::scene::Scene;

/// Data that a technique derives from a scene. It is cached with the scene, so all renderers of the scene share it.
pub trait SceneData: Any + Send + Sync {
    /// Frees data that no picture has used for some seconds.
    fn drop_unused(&self) {}
}

/// A scene with its casters, and data that techniques cache with it.
pub struct ShadowScene {
    scene: Arc<Scene>,
    bounds: Bounds,
    casters: Casters,
    /// Built by the first technique that traces lines of sight.
    rays: OnceLock<ExactRays>,
    /// Cached data, one value for each type.
    kept: Mutex<HashMap<TypeId, Arc<dyn SceneData>>>,
}

impl ShadowScene {
    /// Finds the casters of `scene`. Techniques add their data later.
    pub(in crate::render::shadow) fn with_casters(scene: Arc<Scene>) -> Self {
        Self {
            bounds: scene.bounds(),
            casters: Casters::new(&scene),
            scene,
            rays: OnceLock::new(),
            kept: Mutex::default(),
        }
    }

    /// Returns the scene itself.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the box round the scene, metres.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Returns the opaque triangles, which throw shadows.
    pub(in crate::render::shadow) fn casters(&self) -> &Casters {
        &self.casters
    }

    /// Returns the lines of sight through the scene, in double precision. The first call builds them.
    pub(in crate::render::shadow) fn rays(&self) -> &ExactRays {
        self.rays.get_or_init(|| ExactRays::new(Arc::clone(&self.scene)))
    }

    /// Returns the cached data of type `T`; the first call makes it.
    ///
    /// `make` must not call this function, because the cache is locked meanwhile.
    pub(in crate::render::shadow) fn kept<T: SceneData>(&self, make: impl FnOnce() -> T) -> Arc<T> {
        let data = Arc::clone(self.lock().entry(TypeId::of::<T>()).or_insert_with(|| Arc::new(make())));
        let data: Arc<dyn Any + Send + Sync> = data;
        data.downcast().unwrap_or_else(|_| unreachable!("the key is the type of the value"))
    }

    /// Frees data that no picture has used for some seconds. Called after each picture.
    pub(in crate::render) fn drop_unused(&self) {
        self.lock().values().for_each(|data| data.drop_unused());
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<TypeId, Arc<dyn SceneData>>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
