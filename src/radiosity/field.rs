//! A colour per place and light group.

use glam::Vec3;

/// Values `[place][group]`, stored place by place. Places are patches, elements, light vertices or viewpoints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Field {
    num_groups: usize,
    values: Vec<Vec3>,
}

impl Field {
    /// Returns a field that is zero everywhere.
    #[must_use]
    pub fn zero(num_places: usize, num_groups: usize) -> Self {
        Self { num_groups, values: vec![Vec3::ZERO; num_places * num_groups] }
    }

    /// Returns a field with the given values of places in order, each with `num_groups` groups.
    #[must_use]
    pub fn from_values(num_groups: usize, values: Vec<Vec3>) -> Self {
        Self { num_groups, values }
    }

    /// Number of light groups.
    #[must_use]
    pub fn num_groups(&self) -> usize {
        self.num_groups
    }

    /// Number of places.
    #[must_use]
    pub fn num_places(&self) -> usize {
        self.values.len().checked_div(self.num_groups).unwrap_or(0)
    }

    /// Values of all groups at a place.
    #[must_use]
    pub fn at(&self, place: usize) -> &[Vec3] {
        &self.values[place * self.num_groups..(place + 1) * self.num_groups]
    }

    /// Values of all groups at a place.
    pub fn at_mut(&mut self, place: usize) -> &mut [Vec3] {
        &mut self.values[place * self.num_groups..(place + 1) * self.num_groups]
    }

    /// Sum over the groups at a place.
    #[must_use]
    pub fn total(&self, place: usize) -> Vec3 {
        self.at(place).iter().sum()
    }

    /// All values, place by place.
    #[must_use]
    pub fn values(&self) -> &[Vec3] {
        &self.values
    }

    /// All values, place by place.
    pub fn values_mut(&mut self) -> &mut [Vec3] {
        &mut self.values
    }
}
