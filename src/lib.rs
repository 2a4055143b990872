//! Hemicube: physically correct, view-independent diffuse light for glTF scenes.
//!
//! A bake solves the radiosity equation of a scene once and stores irradiance (lux) at the vertices of its mesh. The
//! result is a standard .glb file, can be measured at any point, and is drawn from any viewpoint, with real-time
//! shadows as an option.
//!
//! # The route
//!
//! ```text
//! .glb --load--> Scene --bake--> BakedScene --picture--> Picture (.png, .exr)
//!                                    |
//!                                    +------measure----> irradiance, lux
//! ```
//!
//! ```
//! use hemicube::glam::Vec3;
//! use hemicube::raytrace::MeasuringPoint;
//! use hemicube::scene::{Light, Material};
//! use hemicube::{BakeSettings, MeasureSettings, Quality, SceneBuilder, bake, measure};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A scene: a file (`hemicube::load`), or built in code.
//! let mut builder = SceneBuilder::new("room");
//! let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
//! builder.room(Vec3::ZERO, Vec3::splat(2.0), [grey; 6]);
//! let lamp = builder.group("lamp");
//! builder.light(Light { group: lamp, ..Light::point(Vec3::ONE, Vec3::splat(10.0)) });
//! let scene = builder.build();
//!
//! // Its light. This needs no GPU; `bake_with` draws hemicubes on one.
//! let baked = bake(&scene, &BakeSettings::preset(Quality::Draft))?.baked;
//!
//! // Irradiance at the middle of the floor; 10 cd at 1 m are 10 lx of direct light.
//! let points = [MeasuringPoint { position: Vec3::new(1.0, 0.0, 1.0), normal: Vec3::Y }];
//! let measured = measure(&baked, &points, &MeasureSettings::preset(Quality::Draft))?;
//! assert!((measured[0].direct.x - 10.0).abs() < 0.01);
//! assert!(measured[0].total.x > measured[0].direct.x);
//! # Ok(())
//! # }
//! ```
//!
//! The folder `examples` of the package shows more: a bake read vertex by vertex, view factors, shadows of each
//! technique, a form-factor method of one's own.
//!
//! # Features
//!
//! * `viewer` (default): the window, [`viewer`].
//! * `cli` (default): the command line, [`cli`].
//!
//! Without them (`default-features = false`) neither winit, egui nor clap is compiled.
//!
//! # The floors
//!
//! A module imports only modules of lower floors.
//!
//! 0. [`base`]: ids, colour, sampling, progress.
//! 1. [`scene`]: a glTF file becomes a validated [`Scene`]. [`gpu`]: the device.
//! 2. [`trace`], [`patch`], [`baked`]: rays, patches and elements, stored light.
//! 3. [`form_factor`], [`raytrace`], [`render`], [`lightmap`]: rows of form factors; traced and drawn pictures of a lit
//!    scene; its light as a texture.
//! 4. [`radiosity`]: direct light, solvers, light at vertices.
//! 5. [`mod@bake`]: the whole job as one recipe.
//! 6. [`viewer`]: the window.
//! 7. [`cli`]: the command line.

pub mod base;
pub mod scene;

pub mod baked;
pub mod gpu;
pub mod patch;
pub mod trace;

pub mod form_factor;
pub mod lightmap;
pub mod raytrace;
pub mod render;

pub mod radiosity;

pub mod bake;

#[cfg(feature = "viewer")]
pub mod viewer;

#[cfg(feature = "cli")]
pub mod cli;

/// The vectors and matrices of this crate's interface.
pub use glam;

pub use bake::{Bake, BakeSettings, MeasureSettings, Measured, Method, Quality, Solver, bake, measure};
pub use baked::BakedScene;
pub use form_factor::FormFactorSource;
pub use gpu::Gpu;
pub use render::{Picture, RenderSettings, ShadowSettings, ShadowTechnique, picture};
pub use scene::gltf::load;
pub use scene::{Scene, SceneBuilder};
