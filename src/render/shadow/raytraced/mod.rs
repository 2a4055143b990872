//! Ray-traced shadows: the reference. They trace a line of sight from each visible point to each light sample, on the
//! CPU.
//!
//! The raster decides which surface a pixel shows ([`visible_points`]), so pictures differ from those of the other
//! techniques only in their shadows. Everything else is computed in double precision. [`ray_origin`] finds the point
//! where the ray through the middle of the pixel hits a triangle. [`traced_light`] tests which side of the triangle
//! faces the light and whether something blocks the light. If a pixel has several samples, they share that point.

mod pixel_rays;
mod ray_origin;
mod traced_light;
mod visible_points;

pub use traced_light::RaytracedLight;
