//! The light of the vertices as a picture shows it: summed over the light groups, and copied to the tiles of a coarse
//! mesh.

pub mod light_tiles;
pub mod weighted_light;
