//! What the user has set in the sections of the panels.

use std::collections::BTreeSet;

use crate::base::ids::InstanceId;

/// Which instances are hidden, selected and listed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Instances that are not drawn; their light and shadows stay as baked.
    pub hidden: BTreeSet<InstanceId>,
    /// The selected instance, tinted in the picture.
    pub chosen: Option<InstanceId>,
    /// Only names that contain this text are listed.
    pub filter: String,
}

/// One of the locations that a piece of advice is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdviceLocation {
    /// Index of the advice.
    pub advice: usize,
    /// Index of the location within the advice.
    pub location: usize,
}

/// Layout of measured grids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSettings {
    /// Distance between points, metres.
    pub spacing: f32,
    /// Height above the surface, metres.
    pub height: f32,
}

/// Which moment of the recorded bake is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReplaySettings {
    /// The recorded moment replaces the finished light.
    pub is_on: bool,
    /// Index of the moment.
    pub moment: usize,
    /// Adds the ambient estimate: the unshot light, spread evenly.
    pub with_ambient: bool,
}
