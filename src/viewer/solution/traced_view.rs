//! The view traced by rays: while the camera rests, the two-pass picture of the view is refined pass by pass.
//!
//! The first pass is the bake; the second gathers its light with rays from the camera.

use glam::Vec3;

use crate::base::progress::Progress;
use crate::raytrace::{Ambient, Film, SecondPass, TwoPassSettings};
use crate::render::{Exposure, RenderSettings, Shading, tone_map_on_cpu};
use crate::scene::{Camera, Scene};
use crate::trace::Tracer;
use crate::viewer::camera::collider::Collider;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::settings::light::GroupDial;
use crate::viewer::solution::solved::SolvedScene;

/// Rays per pixel at which tracing ends.
pub const MAX_RAYS: u32 = 64;

/// A traced picture of the view.
pub struct TracedView {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// RGBA bytes as displayed.
    pub display: Vec<u8>,
    /// Rays per pixel so far.
    pub num_rays: u32,
}

/// The view to trace, and how it is shown.
pub struct TracedViewRequest {
    /// The camera.
    pub camera: Camera,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The render settings. Their exposure is fixed, so that passes do not flicker.
    pub settings: RenderSettings,
    /// Intensities and colours of the light groups.
    pub dials: Vec<GroupDial>,
}

/// Traces one ray per pixel in each pass. After each pass, it calls `on_pass` with the mean of the passes so far.
pub fn trace(solved: &SolvedScene, request: &TracedViewRequest, progress: &dyn Progress, on_pass: impl Fn(TracedView)) {
    let TracedViewRequest { camera, size, settings: render_settings, dials } = request;
    let baked = solved.dimmed(dials);
    let tracer = Tracer::new(&baked.scene);
    let settings = TwoPassSettings { samples: MAX_RAYS, ambient: Ambient::Indirect { final_gather: 0 }, seed: 0 };
    let Some(second) = SecondPass::new(&tracer, &baked, &settings, progress) else { return };
    let mut film = Film::new(*size);
    while film.samples() < MAX_RAYS && second.refine(&mut film, camera, 1, progress) {
        let display = tone_map_on_cpu(*size, film.radiance(), render_settings).display;
        on_pass(TracedView { size: *size, display, num_rays: film.samples() });
    }
}

/// Returns true if a traced view shows the same as rasterisation: `render_settings` shows lit surfaces with all their
/// light, and no culled back lies in view, since backs block rays.
#[must_use]
pub fn matches_rasterisation(
    render_settings: &RenderSettings,
    pose: &CameraPose,
    aspect: f32,
    collider: &Collider,
    scene: &Scene,
) -> bool {
    let shows_all = render_settings.shading == Shading::Lit
        && render_settings.direct == 1.0
        && render_settings.indirect == 1.0
        && render_settings.ambient == Vec3::ZERO;
    shows_all && !(render_settings.cull_back && looks_through_backs(pose, aspect, collider, scene))
}

/// Returns true if a ray of a coarse grid over the picture hits the back of a single-sided surface.
fn looks_through_backs(pose: &CameraPose, aspect: f32, collider: &Collider, scene: &Scene) -> bool {
    const GRID: [i32; 2] = [8, 5];
    let is_double = |t: crate::base::ids::TriangleId| scene.material_of(t).double_sided;
    let mut rays = (-GRID[0]..=GRID[0]).flat_map(|x| (-GRID[1]..=GRID[1]).map(move |y| [x, y]));
    rays.any(|[x, y]| {
        let direction = pose.direction([x as f32 / GRID[0] as f32, y as f32 / GRID[1] as f32], aspect);
        let through = collider.pick(pose.position, direction, is_double).map(|pick| pick.triangle);
        let stopped = collider.pick(pose.position, direction, |_| true).map(|pick| pick.triangle);
        through != stopped
    })
}

/// Returns `render_settings` with automatic exposure replaced by the one metered for the rasterised picture.
#[must_use]
pub fn with_fixed_exposure(render_settings: &RenderSettings, metered_ev: Option<f32>) -> RenderSettings {
    let exposure = match (render_settings.exposure, metered_ev) {
        (Exposure::Auto, Some(ev)) => Exposure::Ev(ev),
        (exposure, _) => exposure,
    };
    RenderSettings { exposure, ..render_settings.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn a_view_through_a_wall_is_not_traced() {
        let scene = builtin::cornell();
        let collider = Collider::new(&scene);
        let render_settings = RenderSettings::default();
        let inside = CameraPose::from_camera(&scene.cameras[0]);
        assert!(matches_rasterisation(&render_settings, &inside, 1.0, &collider, &scene));
        let behind = CameraPose::looking_along(Vec3::new(2.8, 2.7, 12.0), Vec3::NEG_Z);
        let before = CameraPose::looking_along(Vec3::new(2.8, 2.7, -12.0), Vec3::Z);
        assert!(
            matches_rasterisation(&render_settings, &before, 1.0, &collider, &scene)
                && !matches_rasterisation(&render_settings, &behind, 1.0, &collider, &scene)
        );
        assert!(!matches_rasterisation(
            &RenderSettings { direct: 0.0, ..render_settings },
            &inside,
            1.0,
            &collider,
            &scene
        ));
    }

    #[test]
    fn a_metered_exposure_is_kept() {
        let render_settings = RenderSettings::default();
        assert_eq!(with_fixed_exposure(&render_settings, Some(-3.0)).exposure, Exposure::Ev(-3.0));
        let fixed = RenderSettings { exposure: Exposure::Ev(1.0), ..render_settings };
        assert_eq!(with_fixed_exposure(&fixed, Some(-3.0)).exposure, Exposure::Ev(1.0));
    }
}
