//! Bakes that are cancelled, and bakes that reuse rows of form factors from a file.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Quat, Vec3};
use hemicube::bake::{
    Bake, BakeContext, BakeObserver, BakeSettings, Method, Quality, Refinement, Sampling, bake, bake_with,
};
use hemicube::base::progress::{Progress, Stage, Unwatched};
use hemicube::form_factor::row_cache::{RowCache, RowCacheError};
use hemicube::scene::{Light, Scene, SceneBuilder, builtin};

use crate::support::scenes::{glowing, with_groups};

/// Cancels the bake when it reports a stage for the `moment`-th time.
struct StopAt {
    stage: Stage,
    moment: usize,
    count: AtomicUsize,
}

impl StopAt {
    fn new(stage: Stage, moment: usize) -> Self {
        Self { stage, moment, count: AtomicUsize::new(0) }
    }

    /// Creates a watch that counts the reports of a stage and never cancels.
    fn never(stage: Stage) -> Self {
        Self::new(stage, usize::MAX)
    }

    fn num_reports(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }
}

impl Progress for StopAt {
    fn report(&self, stage: Stage, _: f32) {
        self.count.fetch_add(usize::from(stage == self.stage), Ordering::Relaxed);
    }
    fn is_cancelled(&self) -> bool {
        self.num_reports() > self.moment
    }
}

impl BakeObserver for StopAt {}

fn settings() -> BakeSettings {
    BakeSettings {
        element_size: Some(0.2),
        method: Some(Method::Hemisphere),
        hemisphere_rays: 64,
        threshold: 0.1,
        ..BakeSettings::preset(Quality::Draft)
    }
}

fn bake_on(scene: &Scene, row_cache: Option<&RowCache>, observer: &dyn BakeObserver) -> Bake {
    bake_with(scene, &settings(), &BakeContext { gpu: None, row_cache, observer }).unwrap()
}

fn open(path: &Path) -> RowCache {
    RowCache::open(path, 1 << 30).unwrap()
}

/// Builds a room in which a point light casts a hard shadow of a block on the floor, so elements are halved down to the
/// smallest.
fn sharp_room() -> Scene {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::splat(0.7), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(3.0, 2.0, 2.5), [white; 6]);
    builder.block(Vec3::new(1.5, 0.8, 1.2), Vec3::splat(0.3), Quat::from_rotation_y(0.5), white);
    builder.light(Light::point(Vec3::new(1.0, 1.7, 1.0), Vec3::splat(100.0)));
    with_groups(builder.build(), 1)
}

#[test]
fn a_bake_can_be_cancelled_at_any_moment() {
    let scene = sharp_room();
    for stage in [Stage::Mesh, Stage::Direct, Stage::Solve, Stage::Gather] {
        let whole = StopAt::never(stage);
        bake_on(&scene, None, &whole);
        let moments = 0..whole.num_reports();
        assert!(!moments.is_empty(), "{stage:?} is not reported");
        for moment in moments.clone().step_by(moments.len().div_ceil(8)) {
            let bake = bake_on(&scene, None, &StopAt::new(stage, moment));
            assert!(bake.report.work.cancelled, "{stage:?} {moment}");
            let num_vertices = bake.baked.scene.vertices.len();
            for part in bake.baked.light.groups.iter().flat_map(|group| [&group.direct, &group.indirect]) {
                assert_eq!(part.len(), num_vertices);
                assert!(part.iter().all(|light| light.is_finite() && light.min_element() >= 0.0));
            }
        }
    }
}

#[test]
fn a_cancelled_bake_continues_to_the_same_bits() {
    let scene = builtin::cornell();
    let whole = StopAt::never(Stage::Gather);
    let expected = bake_on(&scene, None, &whole);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows");
    let late = StopAt::new(Stage::Gather, whole.num_reports() / 4);
    bake_on(&scene, Some(&open(&path)), &late);
    let rows = open(&path);
    let num_kept = rows.len();
    let resumed = bake_on(&scene, Some(&rows), &Unwatched);
    assert!(num_kept > 100 && rows.num_reused() >= num_kept, "{} of {num_kept} rows", rows.num_reused());
    assert!(rows.len() > num_kept, "no row was left to compute");
    assert_eq!(resumed.baked.light, expected.baked.light);
}

#[test]
fn other_colours_reuse_most_rows_and_other_geometry_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows");
    // Refinement and the number of hemicubes depend on the light, so both are fixed here.
    let settings = settings();
    let settings = BakeSettings {
        refinement: Refinement { max_error: 0.0, ..settings.refinement },
        sampling: Sampling { noise: f32::INFINITY, ..settings.sampling },
        ..settings
    };
    let num_computed = |scene: &Scene| {
        let rows = open(&path);
        let before = rows.len();
        let context = BakeContext { row_cache: Some(&rows), ..BakeContext::default() };
        let cached = bake_with(scene, &settings, &context).unwrap();
        let uncached = bake(scene, &settings).unwrap();
        assert_eq!(cached.baked.light, uncached.baked.light);
        rows.len() - before
    };
    let mut scene = builtin::cornell();
    let num_rows = num_computed(&scene);
    assert!(num_rows > 100);
    scene.materials.iter_mut().for_each(|material| material.base_colour *= Vec3::new(0.9, 0.5, 0.7).extend(1.0));
    // Patches whose unshot power was too small before may shoot now.
    assert!(num_computed(&scene) < num_rows / 20);
    scene.vertices.iter_mut().for_each(|vertex| vertex.position.y *= 1.01);
    assert!(num_computed(&scene) > num_rows / 2);
}

#[test]
fn a_broken_last_record_is_computed_again() {
    let scene = builtin::cornell();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows");
    let expected = bake_on(&scene, Some(&open(&path)), &Unwatched);
    let file = std::fs::File::options().write(true).open(&path).unwrap();
    let length = file.metadata().unwrap().len();
    file.set_len(length - 5).unwrap();
    let rows = open(&path);
    let again = bake_on(&scene, Some(&rows), &Unwatched);
    drop(rows);
    assert_eq!(again.baked.light, expected.baked.light);
    assert_eq!(std::fs::metadata(&path).unwrap().len(), length);
}

#[test]
fn a_row_cache_keeps_to_its_limit_and_spares_other_files() {
    let scene = builtin::cornell();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows");
    let rows = RowCache::open(&path, 100_000).unwrap();
    assert!(matches!(RowCache::open(&path, 100_000), Err(RowCacheError::InUse(_))));
    let light = bake_on(&scene, Some(&rows), &Unwatched).baked.light;
    assert_eq!(light, bake_on(&scene, None, &Unwatched).baked.light);
    let length = std::fs::metadata(&path).unwrap().len();
    assert!((50_000..=100_000).contains(&length), "{length}");
    let other = folder.path().join("letter.txt");
    std::fs::write(&other, "Dear reader").unwrap();
    let message = RowCache::open(&other, 100_000).unwrap_err().to_string();
    assert!(message.contains("letter.txt") && message.contains("not a row cache"), "{message}");
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "Dear reader");
}
