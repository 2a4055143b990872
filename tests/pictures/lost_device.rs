//! A lost device: every result is an error, never a black picture.

use glam::Vec3;
use hemicube::gpu::{Gpu, GpuError, Stopwatch};
use hemicube::render::picture;

use super::stage::{SIZE, plain};
use crate::support::quads::{Quads, paint, square_camera};

#[test]
fn a_picture_of_a_lost_device_is_an_error_that_says_why() {
    // A device of its own, because the other tests use theirs at the same time.
    let Ok(gpu) = Gpu::headless() else { return };
    let quads = Quads::square(paint(Vec3::ONE), Vec3::ONE);
    let draw = || picture(&gpu, &quads.baked, &square_camera(), [SIZE; 2], &plain());
    assert!(draw().is_ok() && gpu.check().is_ok());
    gpu.device.destroy();
    let error = draw().expect_err("the device is lost");
    assert!(matches!(&error, GpuError::Lost(reason) if !reason.is_empty()), "{error}");
    assert!(gpu.check().is_err() && gpu.wait().is_err());
    assert!(Stopwatch::new(&gpu).read(&gpu).is_err());
}
