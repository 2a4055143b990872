//! The parts of the window around the sections: theme, widgets, status line, messages, key sheet and tour.

pub mod help;
pub mod message;
pub mod status;
pub mod theme;
pub mod tour;
pub mod widgets;
