//! Ray-traced shadows: the truth. One line of sight from each visible point to each light sample, on the CPU.
//!
//! The raster says which surface a pixel shows, so that nothing but the shadow differs from the other techniques; all
//! else is found anew in double precision: the point where the line through the middle of the pixel meets a triangle,
//! the side that this triangle turns to the light, and what stands between. With several samples a pixel all of them
//! share that one point.

use glam::{DMat4, DVec2, DVec3, DVec4, Vec3, Vec4};
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::depth_prepass::DepthPrepass;
use super::exact_rays::{ExactRays, Line};
use super::light_samples::LightSample;
use super::light_targets::LightTargets;
use super::real_time::Subject;
use super::visible_points::{VisiblePoint, VisiblePoints};
use crate::gpu::{Gpu, GpuError};
use crate::render::View;

/// A line of sight begins this share of the way from its point to the eye: what lies in the same place as the surface
/// that is seen does not shade it.
const TOWARDS_EYE: f64 = 1e-5;
/// Depth of a point by which the line through a pixel is laid.
const SOME_DEPTH: f64 = 0.5;
/// As far as the raster moves the corners of triangles, pixels, with room to spare.
const SNAP: f64 = 1.0 / 128.0;
const CORNERS: [DVec2; 4] = [DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
/// Places on a line this close to one another, as a share of their distance, are one.
const SAME_PLACE: f64 = 1e-3;
/// Cosine between a triangle's normal and a shading normal of its own.
const ALIKE: f64 = 0.9;

/// Direct light by rays, for pictures of any number of samples a pixel.
pub struct RaytracedLight {
    prepass: DepthPrepass,
    points: VisiblePoints,
    targets: Option<LightTargets>,
    /// What the last picture showed.
    irradiance: Vec<Vec4>,
}

/// A visible point, found again in double precision.
struct Place {
    /// Where lines of sight begin, metres.
    origin: DVec3,
    /// What the raster found.
    visible: VisiblePoint,
    /// Corners of the triangle, unless the line through the pixel misses it by a hair.
    triangle: Option<[DVec3; 3]>,
}

impl RaytracedLight {
    /// Passes that find the points from which rays begin.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        Self {
            prepass: DepthPrepass::new(gpu, frame_layout, 1),
            points: VisiblePoints::new(gpu, frame_layout),
            targets: None,
            irradiance: Vec::new(),
        }
    }

    /// Gives back the textures that visible points are found in, until a picture needs them again.
    pub fn release_targets(&mut self) {
        self.targets = None;
    }

    /// Irradiance times pre-exposure, the fourth channel counting the samples seen, added to that of the last picture where
    /// it `goes_on`; black where the device was lost, which the next read-back tells.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        samples: &[LightSample],
        goes_on: bool,
    ) -> wgpu::TextureView {
        let places = self.places(gpu, size, subject).unwrap_or_default();
        let of = |place: &Place| {
            let mut sum = Vec4::ZERO;
            for sample in samples {
                let received = received(subject, &place.visible, sample);
                if received.max_element() > 0.0 && is_lit(subject, place, sample) {
                    sum += (received * subject.scene.pre_exposure).extend(1.0);
                }
            }
            sum
        };
        let mut irradiance: Vec<Vec4> = places.par_iter().map(|place| place.as_ref().map_or(Vec4::ZERO, of)).collect();
        irradiance.resize((size[0] * size[1]) as usize, Vec4::ZERO);
        if goes_on {
            irradiance.iter_mut().zip(&self.irradiance).for_each(|(sum, last)| *sum += last);
        }
        self.irradiance = irradiance;
        upload(gpu, size, &self.irradiance)
    }

    /// Which pixels each light sample lights, `[sample][pixel]`.
    ///
    /// # Errors
    /// The device was lost.
    pub fn decisions(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        samples: &[LightSample],
    ) -> Result<Vec<Vec<bool>>, GpuError> {
        let places = self.places(gpu, size, subject)?;
        let lights = |sample: &LightSample, place: &Place| {
            received(subject, &place.visible, sample).max_element() > 0.0 && is_lit(subject, place, sample)
        };
        let of_sample =
            |sample| places.par_iter().map(|place| place.as_ref().is_some_and(|place| lights(sample, place))).collect();
        Ok(samples.iter().map(of_sample).collect())
    }

    fn places(&mut self, gpu: &Gpu, size: [u32; 2], subject: Subject<'_>) -> Result<Vec<Option<Place>>, GpuError> {
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => LightTargets::new(gpu, size, 1),
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepass.draw(&mut encoder, &targets, subject.frame, subject.seen, subject.settings);
        gpu.queue.submit([encoder.finish()]);
        let points = self.points.find(gpu, &targets, subject.frame, subject.seen, subject.settings);
        self.targets = Some(targets);
        let lines = PixelLines::new(subject.view, size);
        let rays = subject.shadows.rays();
        let place = |(pixel, visible): (usize, Option<VisiblePoint>)| {
            visible.map(|visible| Place::new(rays, &lines, pixel, visible))
        };
        Ok(points?.into_par_iter().enumerate().map(place).collect())
    }
}

/// The lines through the middles of a picture's pixels, in double precision.
struct PixelLines {
    world_from_projection: DMat4,
    /// Homogeneous.
    eye: DVec4,
    size: [u32; 2],
}

impl PixelLines {
    fn new(view: &View, size: [u32; 2]) -> Self {
        let world_from_projection = view.projection_from_world().as_dmat4().inverse();
        Self { world_from_projection, eye: view.eye().as_dvec4(), size }
    }

    /// From the near plane away from the eye, so many pixels off the middle.
    fn through(&self, pixel: usize, off: DVec2) -> Line {
        let [width, height] = self.size.map(f64::from);
        let (column, row) = ((pixel % self.size[0] as usize) as f64, (pixel / self.size[0] as usize) as f64);
        let (x, y) = (2.0 * (column + 0.5 + off.x) / width - 1.0, 1.0 - 2.0 * (row + 0.5 + off.y) / height);
        let at = |depth| self.world_from_projection.project_point3(DVec3::new(x, y, depth));
        let origin = at(1.0);
        Line { origin, direction: (at(SOME_DEPTH) - origin).normalize(), reach: f64::INFINITY }
    }

    /// From a point to the eye, metres; one metre towards it where it is infinitely far.
    fn towards_eye(&self, point: DVec3) -> DVec3 {
        self.eye.truncate() - self.eye.w * point
    }
}

impl Place {
    /// The place of a triangle that the raster shows in a pixel.
    fn new(rays: &ExactRays, lines: &PixelLines, pixel: usize, visible: VisiblePoint) -> Self {
        let middle = lines.through(pixel, DVec2::ZERO);
        let found = Found::new(rays, lines, middle, &visible).filter(Found::is_clear).or_else(|| {
            // On the edge of a triangle: the raster, which snaps corners to a part of a pixel, may show another than
            // the line through the middle meets.
            let beside = CORNERS.map(|corner| lines.through(pixel, SNAP * corner));
            let found = [middle].into_iter().chain(beside).filter_map(|line| Found::new(rays, lines, line, &visible));
            found.max_by(|a, b| a.likeness.total_cmp(&b.likeness))
        });
        let point = found.as_ref().map_or(visible.point.as_dvec3(), |found| found.point);
        let origin = point + TOWARDS_EYE * lines.towards_eye(point);
        Self { origin, visible, triangle: found.map(|found| found.corners) }
    }
}

/// A triangle where the raster found a point.
struct Found {
    point: DVec3,
    corners: [DVec3; 3],
    /// Cosine between its normal and that which the raster found, on the side that is seen.
    likeness: f64,
}

impl Found {
    fn new(rays: &ExactRays, lines: &PixelLines, line: Line, visible: &VisiblePoint) -> Option<Self> {
        let rough = (visible.point.as_dvec3() - line.origin).dot(line.direction);
        let met = rays.nearest_to(line, rough).filter(|met| (met.distance - rough).abs() <= SAME_PLACE * rough)?;
        let (point, corners) = (line.origin + line.direction * met.distance, rays.corners(met.triangle));
        let normal = front_normal(corners).normalize_or_zero();
        let seen = if normal.dot(lines.towards_eye(point)) < 0.0 { -normal } else { normal };
        Some(Self { point, corners, likeness: seen.dot(visible.normal.as_dvec3()) })
    }

    /// Beyond doubt the triangle that the raster shows.
    fn is_clear(&self) -> bool {
        self.likeness > ALIKE
    }
}

/// Irradiance of a light sample where nothing stands between.
fn received(subject: Subject<'_>, visible: &VisiblePoint, sample: &LightSample) -> Vec3 {
    sample.irradiance(visible.point, visible.normal) * subject.settings.group_weight(sample.light.group)
}

/// Nothing solid stands between a visible point and a light sample, and its triangle shows the light the side it shows
/// the eye.
fn is_lit(subject: Subject<'_>, place: &Place, sample: &LightSample) -> bool {
    let light = sample.place().as_dvec4();
    let eye = subject.view.eye().as_dvec4();
    if place.triangle.is_some_and(|corners| turns_its_back(corners, eye, light)) {
        return false;
    }
    !subject.shadows.rays().is_blocked(Line::between(place.origin, light))
}

/// The eye and the light, both homogeneous, are on different sides of a triangle.
fn turns_its_back(corners: [DVec3; 3], eye: DVec4, light: DVec4) -> bool {
    let normal = front_normal(corners);
    let height = |place: DVec4| normal.dot(place.truncate() - place.w * corners[0]);
    height(eye) * height(light) < 0.0
}

fn front_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// A texture of one sample a pixel that holds irradiance.
fn upload(gpu: &Gpu, size: [u32; 2], irradiance: &[Vec4]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("ray-traced irradiance"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &descriptor,
        Default::default(),
        bytemuck::cast_slice(irradiance),
    );
    texture.create_view(&Default::default())
}
