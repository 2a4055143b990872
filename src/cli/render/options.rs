//! Options of `hemicube render`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::{Vec2, Vec3, Vec3Swizzles as _};

use super::ray_options::{RayOptions, RendererName};
use super::shadow_options::ShadowOptions;
use crate::cli::bake_options::BakeOptions;
use crate::cli::scene_input::VariantOption;
use crate::cli::value::{exposure, numbers, positive, unit_normal};
use crate::raytrace::MeasuringPoint;
use crate::render::Exposure;
use crate::scene::Camera;

/// Options of `hemicube render`.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// Scene to draw: .glb or .gltf, baked or not (FILE#NAME chooses one of its scenes), or builtin:gallery,
    /// builtin:cornell or builtin:mirrors.
    #[arg(default_value = "builtin:gallery")]
    pub scene: PathBuf,
    /// Material variant of the file.
    #[command(flatten)]
    pub variant: VariantOption,
    /// The picture: .png as displayed, .exr as linear radiance (nit, before exposure).
    #[arg(short, long, value_name = "IMG")]
    pub output: PathBuf,
    /// Camera of the scene, by name or by index from 0 [default: the first camera, or an overview if there is none].
    #[arg(long, value_name = "NAME|INDEX")]
    pub camera: Option<String>,
    /// Position of the camera (metres), viewing direction and vertical field of view (degrees), as the viewer copies
    /// them.
    #[arg(long, value_name = "X,Y,Z,DX,DY,DZ,FOV", value_parser = camera_pose, allow_hyphen_values = true,
          conflicts_with = "camera")]
    pub eye: Option<Camera>,
    /// Draws the view from a patch instead: the unfolded hemicube at this position (metres) with this normal. A second
    /// picture, IMG-items.png, has a colour for each element.
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ", value_parser = patch_viewpoint, allow_hyphen_values = true,
          conflicts_with_all = ["camera", "eye", "renderer", "reference"])]
    pub hemicube_at: Option<MeasuringPoint>,
    /// Width and height of the picture, pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: Size,
    /// Exposure in stops: displayed = radiance x 2^EV; auto meters the picture.
    #[arg(long, value_name = "EV|auto", default_value = "auto", value_parser = exposure, allow_negative_numbers = true)]
    pub exposure: Exposure,
    /// Which light the picture shows [default: radiosity; indirect+direct with --renderer two-pass or path].
    #[arg(long, value_enum, value_name = "MODE")]
    pub lighting: Option<Lighting>,
    /// Options of traced pictures.
    #[command(flatten)]
    pub rays: RayOptions,
    /// Compares the picture with this one (.png or .exr), writes the visible difference to IMG-difference.png, and
    /// fails if they differ by more than --threshold.
    #[arg(long, value_name = "IMG")]
    pub reference: Option<PathBuf>,
    /// Largest relative root mean square error against the reference.
    #[arg(long, value_name = "T", default_value = "0.05", value_parser = positive, requires = "reference")]
    pub threshold: f32,
    /// Shadows of direct light.
    #[command(flatten)]
    pub shadows: ShadowOptions,
    /// How to bake a file that stores no light.
    #[command(flatten)]
    pub bake: BakeOptions,
}

/// Which light a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Lighting {
    /// Direct light.
    Direct,
    /// A constant term as strong as the mean of the stored light; needs no bake.
    Ambient,
    /// All light of the bake.
    Radiosity,
    /// The indirect light of the bake, and direct light.
    #[value(name = "indirect+direct")]
    IndirectAndDirect,
}

/// Width and height in pixels. A type of its own, since clap reads a plain array as an option that may be repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl RenderArgs {
    /// Returns the chosen lighting, or the default of the renderer.
    #[must_use]
    pub fn lighting(&self) -> Lighting {
        let default = match self.rays.renderer {
            RendererName::Raster => Lighting::Radiosity,
            RendererName::TwoPass | RendererName::Path => Lighting::IndirectAndDirect,
        };
        self.lighting.unwrap_or(default)
    }
}

/// Parses WxH.
fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides
        .filter(|sides| sides.iter().all(|&side| side > 0))
        .map(Size)
        .ok_or_else(|| "must look like 1280x720".to_owned())
}

/// Parses X,Y,Z,DX,DY,DZ,FOV.
fn camera_pose(text: &str) -> Result<Camera, String> {
    let [x, y, z, dx, dy, dz, fov] = numbers(text)
        .filter(|numbers: &[f32; 7]| (1.0..=170.0).contains(&numbers[6]))
        .ok_or("must be seven numbers, X,Y,Z,DX,DY,DZ,FOV, FOV from 1 to 170")?;
    let (position, direction) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
    let direction = direction.try_normalize().filter(|d| d.xz() != Vec2::ZERO).ok_or("DX,DY,DZ must not be upright")?;
    Ok(Camera::looking_at("eye", position, position + direction, fov.to_radians()))
}

/// Parses X,Y,Z,NX,NY,NZ.
fn patch_viewpoint(text: &str) -> Result<MeasuringPoint, String> {
    let [x, y, z, nx, ny, nz] = numbers(text).ok_or("must be six numbers, X,Y,Z,NX,NY,NZ")?;
    Ok(MeasuringPoint { position: Vec3::new(x, y, z), normal: unit_normal(Vec3::new(nx, ny, nz))? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_two_positive_numbers() {
        assert_eq!(size("640x360"), Ok(Size([640, 360])));
        for wrong in ["640", "0x10", "axb", "640x", "-1x5", "1x2x3"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_camera_pose_is_seven_numbers_and_not_upright() {
        let camera = camera_pose("1,1.65,-2,0,0,-2,60").expect("seven numbers");
        assert_eq!(camera.position, Vec3::new(1.0, 1.65, -2.0));
        assert!((camera.forward() - Vec3::NEG_Z).length() < 1e-5);
        for wrong in ["", "1,2,3,0,0,-1", "1,2,3,0,0,-1,0", "1,2,3,0,1,0,60", "1,2,3,0,0,0,60", "a,2,3,0,0,-1,60"] {
            assert!(camera_pose(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_patch_viewpoint_is_a_position_and_a_normal() {
        let point = patch_viewpoint("1,-2, 3.5,0,0,2").expect("six numbers");
        assert_eq!((point.position, point.normal), (Vec3::new(1.0, -2.0, 3.5), Vec3::Z));
        for wrong in ["", "1,2,3", "1,2,3,0,0,0", "1,2,3,a,0,1", "1,2,3,0,0,1,0", "inf,0,0,0,0,1"] {
            assert!(patch_viewpoint(wrong).is_err(), "{wrong}");
        }
    }
}
