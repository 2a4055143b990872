//! A still camera: the view turns into the two-pass picture, ray by ray, until something moves.

use glam::Vec3;

use super::camera::Eye;
use super::collider::Collider;
use super::errand::{Bearer, Finding};
use super::settings::GroupDial;
use super::solved::Solved;
use crate::raytrace::{Ambient, Film, SecondPass, TwoPassSettings};
use crate::render::{Exposure, RenderSettings, Shading, tone_map_on_cpu};
use crate::scene::{Camera, Scene};
use crate::trace::Tracer;

/// Rays a pixel at which the picture is as good as it gets.
pub const MAX_RAYS: u32 = 64;

/// A traced picture.
pub struct Exposed {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// RGBA bytes as displayed.
    pub display: Vec<u8>,
    /// Rays a pixel so far.
    pub num_rays: u32,
}

/// What is to be traced.
pub struct Subject {
    /// From where.
    pub camera: Camera,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// How it is shown; its exposure is fixed, so that nothing jumps.
    pub settings: RenderSettings,
    /// How the light groups are dimmed.
    pub dials: Vec<GroupDial>,
}

/// Traces pass after pass, one ray a pixel each, and brings the mean after each.
pub fn trace(bearer: &Bearer, solved: &Solved, wanted: &Subject) {
    let Subject { camera, size, settings: render_settings, dials } = wanted;
    let baked = solved.dimmed(dials);
    let tracer = Tracer::new(&baked.scene);
    let settings = TwoPassSettings { samples: MAX_RAYS, ambient: Ambient::Indirect { final_gather: 0 }, seed: 0 };
    let Some(second) = SecondPass::new(&tracer, &baked, &settings, bearer) else { return };
    let mut film = Film::new(*size);
    while film.samples() < MAX_RAYS && second.refine(&mut film, camera, 1, bearer) {
        let display = tone_map_on_cpu(*size, film.radiance(), render_settings).display;
        bearer.bring(Finding::Still(Box::new(Exposed { size: *size, display, num_rays: film.samples() })));
    }
}

/// The second pass shows the same light as the raster: all of it, on lit surfaces, and the view is not through the back of a
/// wall, which rays cannot see through.
#[must_use]
pub fn suits(render_settings: &RenderSettings, eye: &Eye, aspect: f32, collider: &Collider, scene: &Scene) -> bool {
    let shows_all = render_settings.shading == Shading::Lit
        && render_settings.direct == 1.0
        && render_settings.indirect == 1.0
        && render_settings.ambient == Vec3::ZERO;
    shows_all && !(render_settings.cull_back && looks_through_backs(eye, aspect, collider, scene))
}

/// Some of a coarse grid of rays meets the back of a single-sided surface.
fn looks_through_backs(eye: &Eye, aspect: f32, collider: &Collider, scene: &Scene) -> bool {
    const GRID: [i32; 2] = [8, 5];
    let is_double = |t: crate::base::ids::TriangleId| scene.material_of(t).double_sided;
    let mut rays = (-GRID[0]..=GRID[0]).flat_map(|x| (-GRID[1]..=GRID[1]).map(move |y| [x, y]));
    rays.any(|[x, y]| {
        let direction = eye.direction([x as f32 / GRID[0] as f32, y as f32 / GRID[1] as f32], aspect);
        let through = collider.pick(eye.position, direction, is_double).map(|pick| pick.triangle);
        let stopped = collider.pick(eye.position, direction, |_| true).map(|pick| pick.triangle);
        through != stopped
    })
}

/// The exposure that a traced picture is shown with: that of the raster before it.
#[must_use]
pub fn held(render_settings: &RenderSettings, metered_ev: Option<f32>) -> RenderSettings {
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
    fn a_view_through_a_wall_stays_drawn() {
        let scene = builtin::cornell();
        let collider = Collider::new(&scene);
        let render_settings = RenderSettings::default();
        let inside = Eye::from_camera(&scene.cameras[0]);
        assert!(suits(&render_settings, &inside, 1.0, &collider, &scene));
        let behind = Eye::looking_along(Vec3::new(2.8, 2.7, 12.0), Vec3::NEG_Z);
        let before = Eye::looking_along(Vec3::new(2.8, 2.7, -12.0), Vec3::Z);
        assert!(
            suits(&render_settings, &before, 1.0, &collider, &scene)
                && !suits(&render_settings, &behind, 1.0, &collider, &scene)
        );
        assert!(!suits(&RenderSettings { direct: 0.0, ..render_settings }, &inside, 1.0, &collider, &scene));
    }

    #[test]
    fn a_metered_exposure_is_held() {
        let render_settings = RenderSettings::default();
        assert_eq!(held(&render_settings, Some(-3.0)).exposure, Exposure::Ev(-3.0));
        let fixed = RenderSettings { exposure: Exposure::Ev(1.0), ..render_settings };
        assert_eq!(held(&fixed, Some(-3.0)).exposure, Exposure::Ev(1.0));
    }
}
