//! A small art gallery: two rooms with soft shadows, colour bleeding, and sunlight that reaches the ceiling by
//! reflection.
//!
//! The hall is white: sunlight falls through three high windows past a row of columns on to an oak floor, and a flight
//! of steps leads to a dais before a blue-green wall under a luminous ceiling. A doorway connects it to a dim room with
//! a deep red wall, two pendant lamps and a spot on a white sphere. X runs from the red room to the dais, Z from the
//! pictures to the windows.

mod exhibits;
mod finishes;
mod lighting;
mod rooms;

use super::builder::Builder;
use crate::scene::Scene;
use finishes::Finishes;

/// Returns the built-in gallery: about 17 m x 7 m, five light groups, four cameras at eye height.
#[must_use]
pub fn gallery() -> Scene {
    let mut builder = Builder::new("gallery");
    let finishes = Finishes::new(&mut builder);
    rooms::build(&mut builder, &finishes);
    rooms::columns(&mut builder, &finishes);
    lighting::windows(&mut builder, &finishes);
    lighting::lamps(&mut builder, &finishes);
    lighting::spot(&mut builder, &finishes);
    exhibits::sculptures(&mut builder, &finishes);
    exhibits::pictures(&mut builder, &finishes);
    exhibits::bench(&mut builder, &finishes);
    builder.camera("entrance", [0.4, 1.6, 3.9], [8.1, 1.45, 3.1], 60.0);
    builder.camera("stairs", [9.3, 2.62, 3.2], [2.6, 0.2, 4.3], 60.0);
    builder.camera("red room", [-0.9, 1.6, 5.0], [-5.0, 1.35, 1.9], 60.0);
    builder.camera("detail", [-4.9, 1.55, 2.75], [-5.9, 1.2, 1.1], 50.0);
    builder.finish()
}

#[cfg(test)]
mod tests;
