//! What is seen from a site, in one look or on average over several.

use glam::Vec3;

use super::contacts::Contact;

/// What a look from a site tells of it.
pub(super) struct Sight {
    /// Irradiance `[g]`.
    pub irradiance: Vec<Vec3>,
    /// Elements close by.
    pub contacts: Vec<Contact>,
    /// Share of back faces.
    pub back: f32,
    /// Harmonic mean distance, metres.
    pub distance: f32,
    /// Distance of the nearest place on an element, metres.
    pub nearest: f32,
}

impl Sight {
    /// What several looks from one place tell together.
    pub fn mean(mut looks: Vec<Self>) -> Self {
        let share = (looks.len() as f32).recip();
        let mean = |value: fn(&Self) -> f32| share * looks.iter().map(value).sum::<f32>();
        let back = mean(|look| look.back);
        let distance = mean(|look| look.distance.recip()).recip();
        let nearest = looks.iter().map(|look| look.nearest).fold(f32::MAX, f32::min);
        let mut irradiance = vec![Vec3::ZERO; looks.first().map_or(0, |look| look.irradiance.len())];
        for look in &looks {
            irradiance.iter_mut().zip(&look.irradiance).for_each(|(sum, &value)| *sum += share * value);
        }
        let contacts = looks.iter_mut().flat_map(|look| look.contacts.drain(..));
        let contacts = contacts.map(|(element, part)| (element, share * part)).collect();
        Self { irradiance, contacts, back, distance, nearest }
    }
}
