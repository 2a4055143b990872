//! Floor 3: form factors, requested in batches of viewpoints and returned as sparse rows.
//!
//! The form factor of a differential area at x with normal n and an element e is
//!
//! F(x, e) = integral over e of cos theta_x cos theta_y / (pi r^2) V(x, y) dA_y,
//!
//! where theta are the angles between the line of length r from x to y and the normals at its ends, and V is 1 if
//! nothing blocks it, else 0. F(x, e) is the share of the power leaving x that arrives at e. By reciprocity (A_i F_ij =
//! A_j F_ji) it is also the weight of e's radiosity in the irradiance at x: E(x) = sum over e of F(x, e) B_e. Hence one
//! row serves shooting and gathering.
//!
//! | method | file | computes |
//! |---|---|---|
//! | closed forms | [`point_to_polygon()`], [`polygon_pair`] | exact factors of polygons, without a mesh |
//! | hemicubes | [`hemicube`] | rows, from item buffers drawn by the GPU |
//! | hemispheres | [`hemisphere`] | rows, from cosine-distributed rays on the CPU |
//!
//! Methods that compute rows implement [`FormFactorSource`]; the tests compare all of them. [`row_cache`] keeps rows in
//! a file.
//!
//! Source: Cohen, Wallace 1993, "Radiosity and Realistic Image Synthesis", chapter 4.

pub mod hemicube;
pub mod hemisphere;
mod point_to_polygon;
pub mod polygon_pair;
mod row;
pub mod row_cache;
mod source;

pub use point_to_polygon::point_to_polygon;
pub use row::{Entry, MAX_BACK_SHARE, Row, Viewpoint};
pub use source::{FormFactorError, FormFactorSource, map_rows};
