//! The volumes of one light. The volume of each triangle is counted by z-pass or by z-fail.
//!
//! z-pass counts faces between eye and point. It is wrong where the near plane is in a volume, because the face through
//! which the path enters the volume is clipped. The cure: triangles whose volumes reach the near plane are few and
//! are counted by z-fail, all others by z-pass. This is valid because a count is a sum over triangles, and each summand
//! may be counted either way (the idea of ZP+, Hornus et al. 2005, "ZP+: correct z-pass stencil shadows", which counts
//! the near plane in a pass of its own).

use glam::{DVec4, Vec3, Vec4};
use rayon::prelude::*;

use super::hull::{Counting, Hull, hull, hull_triangle_by_triangle, terminator};
use super::near_plane::NearPlane;
use super::settings::VolumeSettings;
use super::silhouette::facing;
use crate::render::shadow::shared::casters::{Caster, Casters};
use crate::render::shadow::shared::frame_context::FrameContext;

/// The volumes of one light.
pub struct Volumes {
    /// Volumes that are counted by z-pass.
    pub depth_pass: Hull,
    /// Volumes that are counted by z-fail.
    pub depth_fail: Hull,
    /// Triangles that are dark regardless of the counts.
    pub terminator: Hull,
}

/// The eye, for the cure of z-pass.
pub struct Viewpoint {
    /// Homogeneous position.
    position: DVec4,
    near_plane: NearPlane,
    /// True if backs of single-sided triangles are invisible.
    culls_backs: bool,
}

impl Viewpoint {
    /// Returns the eye of a picture.
    pub fn new(frame: FrameContext<'_>) -> Self {
        Self {
            position: frame.view.eye().as_dvec4(),
            near_plane: NearPlane::new(frame.view),
            culls_backs: frame.render_settings.cull_back,
        }
    }

    /// Returns true if a triangle is not culled.
    fn shows(&self, casters: &Casters, triangle: &Caster) -> bool {
        let [a, b, c] = casters.corners(triangle).map(Vec3::as_dvec3);
        let to_eye = self.position.truncate() - self.position.w * a;
        !self.culls_backs || !triangle.is_single_sided || (b - a).cross(c - a).dot(to_eye) > 0.0
    }
}

impl Volumes {
    /// Computes the volumes of a light at a homogeneous position.
    pub fn new(
        casters: &Casters,
        viewpoint: &Viewpoint,
        light: Vec4,
        counting: Counting,
        settings: &VolumeSettings,
    ) -> Self {
        let facing = facing(casters, light);
        let none = Hull::default();
        let (depth_pass, depth_fail) = match (counting, settings.near_plane_cure) {
            (Counting::DepthFail, _) if !settings.joined => (none, hull_triangle_by_triangle(casters, &facing, light)),
            (Counting::DepthFail, _) => (none, hull(casters, &facing, light, Counting::DepthFail)),
            (Counting::DepthPass, false) => (hull(casters, &facing, light, Counting::DepthPass), none),
            (Counting::DepthPass, true) => cured(casters, viewpoint, &facing, light),
        };
        Self { depth_pass, depth_fail, terminator: terminator(casters, &facing, light) }
    }
}

/// Returns the volumes for z-pass and the volumes for z-fail. A triangle is counted by z-fail if its volume may reach
/// the near plane.
fn cured(casters: &Casters, viewpoint: &Viewpoint, facing: &[i32], light: Vec4) -> (Hull, Hull) {
    let reaches = |triangle: &Caster| viewpoint.near_plane.is_reached_by_volume(casters.corners(triangle), light);
    let is_fail: Vec<bool> = casters.triangles.par_iter().map(reaches).collect();
    let only = |wanted: bool| -> Vec<i32> {
        facing.iter().zip(&is_fail).map(|(&facing, &is_fail)| if is_fail == wanted { facing } else { 0 }).collect()
    };
    let by_pass = only(false);
    let mut depth_pass = hull(casters, &by_pass, light, Counting::DepthPass);
    // A cap coincides with its triangle. So it is in front of the visible point only if the triangle is invisible.
    for (triangle, &facing) in casters.triangles.iter().zip(&by_pass) {
        if !viewpoint.shows(casters, triangle) {
            depth_pass.add_light_caps(casters, triangle, facing);
        }
    }
    (depth_pass, hull(casters, &only(true), light, Counting::DepthFail))
}
