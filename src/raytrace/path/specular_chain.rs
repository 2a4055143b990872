//! Follows rays through mirrors, glossy metal and panes, to every surface visible in them.

use glam::Vec3;

use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::hit::Surface;

/// Largest number of mirrors and panes in a row that are followed.
const MAX_MIRRORS: u32 = 12;

/// How a ray reached a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chain {
    /// Factor by which the radiance from the surface is multiplied.
    pub throughput: Vec3,
    /// Number of mirrors and panes on the way.
    pub num_mirrors: u32,
    /// True if at least one of them reflected the ray.
    pub is_reflected: bool,
    /// Multiple importance sampling weight of the surface's emission for this ray.
    pub emission_share: f32,
}

/// Visits the nearest surface along a ray and those behind mirrors and panes, and returns the number of visited
/// surfaces.
///
/// `prepare` may change a surface before it is visited and followed.
pub(crate) fn follow(
    rays: &RayCaster<'_>,
    mut ray: Ray,
    sampler: &mut Sampler,
    prepare: impl Fn(&mut Surface),
    mut visit: impl FnMut(&Surface, &Chain, &mut Sampler),
) -> u32 {
    let mut chain = Chain { throughput: Vec3::ONE, num_mirrors: 0, is_reflected: false, emission_share: 1.0 };
    while chain.num_mirrors <= MAX_MIRRORS {
        let Some(hit) = rays.meet(&ray, sampler) else { return chain.num_mirrors };
        let mut surface = Surface::at(rays.scene(), &ray, &hit, true);
        prepare(&mut surface);
        chain.emission_share = if surface.emission == Vec3::ZERO { 1.0 } else { rays.emission_share(&ray, &hit) };
        visit(&surface, &chain, sampler);
        chain.num_mirrors += 1;
        let Some(specular) = &surface.specular else { break };
        let Some(way) = specular.scatter(surface.to_viewer, surface.geometric, sampler) else { break };
        chain.throughput *= way.share;
        chain.is_reflected |= !way.is_straight;
        let source = if way.is_straight {
            ray.source.behind_pane()
        } else {
            RaySource::reflected(surface.normal, specular.density(surface.to_viewer, way.direction))
        };
        ray = rays.onward(&surface, way.direction, source);
    }
    chain.num_mirrors
}
