//! Rays followed through mirrors, glossy metal and panes, to all that they show.

use glam::Vec3;

use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use super::surface::Surface;

/// Mirrors and panes in a row that are followed.
const MAX_MIRRORS: u32 = 12;

/// How a ray came to a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trail {
    /// What radiance from the surface is multiplied with.
    pub throughput: Vec3,
    /// Mirrors and panes on the way.
    pub num_mirrors: u32,
    /// One of them was no pane that was passed straight.
    pub is_reflected: bool,
    /// Share of what the surface emits that lamps were not aimed at for.
    pub emission_share: f32,
}

/// Visits the surfaces that a ray meets, the first and those behind mirrors, and says how many there were. `prepare` may
/// change a surface before it is visited and followed.
pub(super) fn follow(
    rays: &PathTracer<'_>,
    mut ray: Ray,
    sampler: &mut Sampler,
    prepare: impl Fn(&mut Surface),
    mut visit: impl FnMut(&Surface, &Trail, &mut Sampler),
) -> u32 {
    let mut trail = Trail { throughput: Vec3::ONE, num_mirrors: 0, is_reflected: false, emission_share: 1.0 };
    while trail.num_mirrors <= MAX_MIRRORS {
        let Some(hit) = rays.meet(&ray, sampler) else { return trail.num_mirrors };
        let mut surface = Surface::at(rays.scene(), &ray, &hit, true);
        prepare(&mut surface);
        trail.emission_share = if surface.emission == Vec3::ZERO { 1.0 } else { rays.path_share(&ray, &hit) };
        visit(&surface, &trail, sampler);
        trail.num_mirrors += 1;
        let Some(specular) = &surface.specular else { break };
        let Some(way) = specular.scatter(surface.to_viewer, surface.geometric, sampler) else { break };
        trail.throughput *= way.share;
        trail.is_reflected |= !way.is_straight;
        let chance = if way.is_straight {
            ray.chance.behind_pane()
        } else {
            Chance::reflected(surface.normal, specular.density(surface.to_viewer, way.direction))
        };
        ray = rays.onward(&surface, way.direction, chance);
    }
    trail.num_mirrors
}
