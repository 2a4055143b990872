//! Lights of the file, and the light groups in which they are dimmed.

pub(super) mod groups;
pub(super) mod photometric;
pub(super) mod punctual;
pub(super) mod stated_groups;
