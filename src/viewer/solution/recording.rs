//! A recording of progressive refinement, shot by shot, that the time machine of the panels steps through.
//!
//! Shooting (Cohen 1988) is repeated on the finished mesh, one patch at a time. Storing every shot would take too much
//! memory: the first shots are stored one by one, later ones at growing distances.

use glam::Vec3;

use crate::baked::{GroupLight, VertexLight};
use crate::base::colour::luminance;
use crate::base::ids::PatchId;
use crate::base::progress::Progress;
use crate::form_factor::hemisphere::Hemispheres;
use crate::patch::PatchMesh;
use crate::radiosity::reconstruction::average;
use crate::radiosity::solver::Solution;
use crate::radiosity::solver::progressive::{Progressive, ProgressiveSettings};
use crate::radiosity::{Field, Viewpoints};
use crate::trace::Tracer;
use crate::viewer::solution::solved::SolvedScene;

/// Unshot share of the light at which the recording ends.
const THRESHOLD: f32 = 0.01;
/// The recording ends after this many shots per patch on average.
const MAX_PASSES: usize = 16;
/// Number of first shots that are stored one by one.
const SINGLE_SHOTS: usize = 24;
/// After n shots, the next stored moment is n / GROWTH shots later.
const GROWTH: usize = 5;
/// Limit on the stored light, bytes.
const LIGHT_BYTES: usize = 192 << 20;
/// Limit on the cached form factors, bytes.
const ROW_BYTES: usize = 256 << 20;
/// Number of rays that estimate the form factors of a shooter.
const NUM_RAYS: u32 = 512;

/// A recording of progressive refinement.
#[derive(Default)]
pub struct Recording {
    /// The stored moments in order. The first has direct light only.
    pub moments: Vec<Moment>,
    /// Number of patches, which is the number of shots of one pass.
    pub num_patches: usize,
}

/// The light after a number of shots.
pub struct Moment {
    /// Shots so far.
    pub num_shots: usize,
    /// The patch that shot last.
    pub shooter: Option<PatchId>,
    /// Share of the reflected light that is unshot.
    pub unshot_share: f64,
    /// Indirect irradiance at the light vertices `[l][g]`.
    indirect: Field,
    /// Irradiance of the unshot light, spread evenly over the scene `[g]` (the ambient estimate).
    ambient: Vec<Vec3>,
}

impl Recording {
    /// Repeats the shooting, patch by patch. Returns `None` if it was cancelled or the bake was loaded from a file.
    ///
    /// # Errors
    /// Returns an error if form factors cannot be computed.
    pub fn record(solved: &SolvedScene, progress: &dyn Progress) -> anyhow::Result<Option<Self>> {
        if solved.report.is_none() {
            return Ok(None);
        }
        let direct = solved.direct_on_elements();
        let mesh = &solved.mesh;
        let tracer = Tracer::new(&solved.scene);
        let mut method = Hemispheres::new(&tracer, mesh, NUM_RAYS);
        let settings = ProgressiveSettings {
            threshold: THRESHOLD,
            max_shots_a_patch: MAX_PASSES,
            points_a_patch: 1,
            patches_a_batch: 1,
            row_bytes: ROW_BYTES,
        };
        let mut solver = Progressive::new(mesh, Viewpoints::new(&solved.scene), direct, settings);
        let max_moments = max_moments(mesh, solved.baked.light.groups.len());
        let mut moments = vec![Moment::of(mesh, solver.solution(), None, solver.unshot_share())];
        let mut next = 1;
        while !solver.is_done() && moments.len() < max_moments {
            progress.rest();
            let shooter = brightest(solver.solution());
            solver.step(&mut method, progress)?;
            if progress.is_cancelled() {
                return Ok(None);
            }
            if solver.solution().num_shots >= next || solver.is_done() {
                moments.push(Moment::of(mesh, solver.solution(), shooter, solver.unshot_share()));
                next = shot_after(solver.solution().num_shots);
            }
        }
        Ok(Some(Self { moments, num_patches: mesh.patches.len() }))
    }
}

impl Moment {
    fn of(mesh: &PatchMesh, solution: &Solution, shooter: Option<PatchId>, unshot_share: f64) -> Self {
        Self {
            num_shots: solution.num_shots,
            shooter,
            unshot_share,
            indirect: average(mesh, &solution.indirect),
            ambient: solution.ambient_estimate(mesh),
        }
    }

    /// Returns the light of this moment at the vertices of the bake: direct light as baked, indirect light as shot so
    /// far. Adds the ambient estimate of the unshot light if `with_ambient`.
    #[must_use]
    pub fn light(&self, solved: &SolvedScene, with_ambient: bool) -> VertexLight {
        let of_group = |(g, baked): (usize, &GroupLight)| {
            let ambient = if with_ambient { self.ambient[g] } else { Vec3::ZERO };
            let indirect = solved.mesh.light_vertex_of.iter().map(|&l| self.indirect.at(l as usize)[g] + ambient);
            GroupLight { direct: baked.direct.clone(), indirect: indirect.collect() }
        };
        VertexLight { groups: solved.baked.light.groups.iter().enumerate().map(of_group).collect() }
    }
}

/// Returns the patch that shoots next: the first one with the greatest unshot power.
fn brightest(solution: &Solution) -> Option<PatchId> {
    let power = |p: usize| luminance(solution.unshot.total(p));
    let better = |best: usize, p: usize| if power(p) > power(best) { p } else { best };
    (0..solution.unshot.num_places()).reduce(better).map(PatchId::new)
}

/// Returns the number of shots at the next stored moment after `num_shots`.
fn shot_after(num_shots: usize) -> usize {
    if num_shots < SINGLE_SHOTS { num_shots + 1 } else { num_shots + num_shots.div_ceil(GROWTH) }
}

fn max_moments(mesh: &PatchMesh, num_groups: usize) -> usize {
    let bytes = mesh.light_vertices.len() * num_groups * size_of::<Vec3>();
    (LIGHT_BYTES / bytes.max(1)).clamp(4, 256)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::{BakeSettings, MeshBudget, Method, Quality, bake};
    use crate::base::progress::Unwatched;
    use crate::scene::builtin;
    use std::sync::Arc;

    #[test]
    fn a_recording_goes_from_direct_light_to_nearly_all_light() {
        let scene = Arc::new(builtin::cornell());
        let preset = BakeSettings::preset(Quality::Draft);
        let settings = BakeSettings {
            method: Some(Method::Hemisphere),
            budget: MeshBudget { elements: 800.0, patches: 100.0 },
            ..preset
        };
        let done = bake(&scene, &settings).expect("the box is baked");
        let solved = SolvedScene::of_bake(scene, done, &settings);
        let recording = Recording::record(&solved, &Unwatched).expect("rays do not fail").expect("it was baked here");
        let shots: Vec<usize> = recording.moments.iter().map(|moment| moment.num_shots).collect();
        assert_eq!(shots[..5], [0, 1, 2, 3, 4]);
        assert!(recording.moments.windows(2).all(|pair| pair[1].unshot_share < pair[0].unshot_share + 1e-6));
        let total = |moment: &Moment| -> f32 {
            let light = moment.light(&solved, false);
            light.groups.iter().flat_map(|group| &group.indirect).map(|value| luminance(*value)).sum()
        };
        let baked: f32 =
            solved.baked.light.groups.iter().flat_map(|group| &group.indirect).map(|value| luminance(*value)).sum();
        let (first, last) = (&recording.moments[0], recording.moments.last().expect("the end"));
        assert_eq!(total(first), 0.0);
        assert!((total(last) / baked - 1.0).abs() < 0.1, "{} of {baked}", total(last));
        assert!(last.unshot_share <= f64::from(THRESHOLD) && first.shooter.is_none() && last.shooter.is_some());
    }

    #[test]
    fn later_moments_are_farther_apart() {
        assert_eq!((shot_after(0), shot_after(SINGLE_SHOTS - 1)), (1, SINGLE_SHOTS));
        assert_eq!(shot_after(100), 120);
    }
}
