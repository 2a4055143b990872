//! Pictures compared with stored ones in tests/snapshots.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test` replaces them. A failed comparison writes NAME.new.png and NAME.diff.png there.

use std::path::{Path, PathBuf};

use hemicube::render::compare::is_perceptible;
use hemicube::render::{Difference, Picture, Raster, compare};

/// Share of pixels that may differ perceptibly: edges move slightly between drivers.
const TOLERATED_SHARE: f32 = 0.004;
/// Largest change of the mean luminance.
const TOLERATED_MEAN: f32 = 0.005;

/// Asserts that `picture` looks like tests/snapshots/`name`.png.
pub fn assert_snapshot(name: &str, picture: &Picture) {
    let stored = file(name, "png");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        picture.save(&stored).expect("tests/snapshots can be written");
        return;
    }
    let drawn = Raster::displayed(picture);
    let reference = Raster::load(&stored).unwrap_or_else(|error| {
        picture.save(&file(name, "new.png")).expect("tests/snapshots can be written");
        panic!("{error}; UPDATE_SNAPSHOTS=1 writes it")
    });
    let difference = compare(&drawn, &reference).unwrap_or_else(|error| panic!("{name}: {error}"));
    if !is_tolerated(&difference) {
        picture.save(&file(name, "new.png")).expect("tests/snapshots can be written");
        save_marks(&file(name, "diff.png"), &drawn, &reference);
        panic!("{name} looks different: {difference:?}; see {}", file(name, "diff.png").display());
    }
}

fn is_tolerated(difference: &Difference) -> bool {
    difference.perceptible_share <= TOLERATED_SHARE && difference.mean_difference.abs() <= TOLERATED_MEAN
}

fn file(name: &str, extension: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots").join(format!("{name}.{extension}"))
}

/// Writes a picture that is white where the pictures differ perceptibly.
fn save_marks(path: &Path, drawn: &Raster, reference: &Raster) {
    let marks =
        drawn.pixels.iter().zip(&reference.pixels).map(|(&a, &b)| if is_perceptible(a, b, 1.0) { 255 } else { 0 });
    let [width, height] = drawn.size;
    let image = image::GrayImage::from_raw(width, height, marks.collect()).expect("one byte a pixel");
    image.save(path).expect("tests/snapshots can be written");
}
