//! The view from a viewpoint, sampled by one row or the mean of several.

use glam::Vec3;

use super::near_field::NearElement;

/// The data of one view that the final gather uses.
pub(super) struct SampledView {
    /// Irradiance `[g]`.
    pub irradiance: Vec<Vec3>,
    /// Elements near the viewpoint.
    pub near: Vec<NearElement>,
    /// Share of back faces in view.
    pub back: f32,
    /// Harmonic mean distance of the surfaces in view, metres.
    pub distance: f32,
    /// Distance of the nearest point of an element in view, metres.
    pub nearest: f32,
}

impl SampledView {
    /// Returns the mean of several samplings of one view.
    pub fn mean(mut views: Vec<Self>) -> Self {
        let share = (views.len() as f32).recip();
        let mean = |value: fn(&Self) -> f32| share * views.iter().map(value).sum::<f32>();
        let back = mean(|view| view.back);
        let distance = mean(|view| view.distance.recip()).recip();
        let nearest = views.iter().map(|view| view.nearest).fold(f32::MAX, f32::min);
        let mut irradiance = vec![Vec3::ZERO; views.first().map_or(0, |view| view.irradiance.len())];
        for view in &views {
            irradiance.iter_mut().zip(&view.irradiance).for_each(|(sum, &value)| *sum += share * value);
        }
        let near = views.iter_mut().flat_map(|view| view.near.drain(..));
        let near = near.map(|(element, part)| (element, share * part)).collect();
        Self { irradiance, near, back, distance, nearest }
    }
}
