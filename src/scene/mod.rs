//! Floor 1: the scene: triangles in world space, materials, lights, cameras.
//!
//! A [`Scene`] comes from a file ([`gltf::load`]), from [`builtin`], or from code ([`SceneBuilder`]). The loader
//! validates it: all numbers are finite and all indices in range, so no later stage checks again. Node transforms are
//! applied on loading; the node tree is stored only for bakes, which write it. Nothing here uses the GPU.

pub mod builtin;
pub mod camera;
pub(crate) mod chunks;
pub mod doctor;
pub mod gltf;
pub mod light;
pub mod material;
mod model;
pub mod node;
pub mod photometry;
mod reflectance;
mod scene_builder;
mod sides;
mod texture;
mod triangle;

pub use camera::{Camera, Projection};
pub use light::{Arrival, Light, LightKind};
pub use material::{AlphaMode, MAX_REFLECTANCE, Material, SurfacePoint};
pub use model::{ElementRecord, Instance, Scene, VertexAttribute};
pub use node::{NamedNode, Transform};
pub use photometry::Profile;
pub use scene_builder::SceneBuilder;
pub use sides::{Back, Sides};
pub use texture::{Image, Sampler, Texture, TextureSlot, Wrap};
pub use triangle::{Triangle, Vertex, area_of, edge_cross, normal_of};
pub(crate) use triangle::{is_degenerate, is_placeable};
