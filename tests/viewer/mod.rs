//! The viewer: its pictures and its panels.

mod canvas;
mod comparison;
mod panels;
