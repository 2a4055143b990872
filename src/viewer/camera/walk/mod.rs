//! A person who walks through the scene: gravity, steps, walls to slide along, and no way out of the world.

mod body;
mod walker;

pub use body::Body;
pub use walker::Walker;

#[cfg(test)]
mod tests;
