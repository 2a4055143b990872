//! A person who walks through the scene: gravity, steps, sliding along walls, return after a fall out of the scene.

mod body;
mod walker;

pub use body::Body;
pub use walker::Walker;

#[cfg(test)]
mod tests;
