//! Ray-traced shadows: the reference. One line of sight from each visible point to each light sample, on the processor.
//!
//! The raster decides which surface a pixel shows ([`visible_points`]), so that pictures differ from those of the
//! other techniques only in their shadows. Everything else is computed anew in double precision: [`ray_origin`] finds
//! the point where the ray through the middle of the pixel meets a triangle, and [`traced_light`] which side of it
//! faces the light and what stands between. With several samples a pixel all of them share that point.

mod pixel_rays;
mod ray_origin;
mod traced_light;
mod visible_points;

pub use traced_light::RaytracedLight;
