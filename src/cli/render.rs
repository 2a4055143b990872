//! `hemicube render`: a picture of a scene, with the light stored in the file or baked now.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use glam::{Vec2, Vec3, Vec3Swizzles as _};

use super::bake_options::{BakeOptions, VariantOption, bake_device, lit_scene, load, positive};
use super::judge::judge;
use super::patch_view::{patch_viewpoint, view_from_patch};
use super::ray_options::{RayOptions, RendererName};
use super::shadow_options::{ShadowOptions, compare_shadows};
use crate::baked::{self, BakedScene, VertexLight};
use crate::gpu::Gpu;
use crate::raytrace::MeasuringPoint;
use crate::render::picture::check_size;
use crate::render::{Exposure, FileKind, Picture, Raster, RenderSettings, develop, picture};
use crate::scene::{Camera, Scene};

/// Options of `hemicube render`.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// Scene to draw: .glb or .gltf, baked or not (FILE#NAME chooses one of its scenes), or builtin:gallery,
    /// builtin:cornell or builtin:mirrors.
    #[arg(default_value = "builtin:gallery")]
    pub scene: PathBuf,
    /// Which materials it wears.
    #[command(flatten)]
    pub variant: VariantOption,
    /// The picture: .png as displayed, .exr as linear radiance (nit, before exposure).
    #[arg(short, long, value_name = "IMG")]
    pub output: PathBuf,
    /// Camera of the scene, by name or by number from 0 [default: the first, or an overview where there is none].
    #[arg(long, value_name = "NAME|INDEX")]
    pub camera: Option<String>,
    /// Eye, direction of sight and vertical field of view in degrees, as the viewer copies them.
    #[arg(long, value_name = "X,Y,Z,DX,DY,DZ,FOV", value_parser = eye, allow_hyphen_values = true,
          conflicts_with = "camera")]
    pub eye: Option<Camera>,
    /// Draws what a patch sees instead: the unfolded hemicube at this place with this normal; a second picture,
    /// IMG-items.png, has a colour for each element.
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ", value_parser = patch_viewpoint, allow_hyphen_values = true,
          conflicts_with_all = ["camera", "eye", "renderer", "reference"])]
    pub hemicube_at: Option<MeasuringPoint>,
    /// Pixels across and down.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: Size,
    /// Displayed = radiance x 2^EV; auto meters the picture.
    #[arg(long, value_name = "EV|auto", default_value = "auto", value_parser = exposure, allow_negative_numbers = true)]
    pub exposure: Exposure,
    /// Which light is shown [default: radiosity; indirect+direct with --renderer two-pass].
    #[arg(long, value_enum, value_name = "MODE")]
    pub lighting: Option<Lighting>,
    /// How the picture is made.
    #[command(flatten)]
    pub rays: RayOptions,
    /// Compares the picture with this one (.png or .exr), writes what an eye sees of the difference to IMG-difference.png,
    /// and fails where they differ too much.
    #[arg(long, value_name = "IMG")]
    pub reference: Option<PathBuf>,
    /// Largest relative root mean square error against the reference.
    #[arg(long, value_name = "T", default_value = "0.05", value_parser = positive, requires = "reference")]
    pub threshold: f32,
    /// Which shadows direct light throws.
    #[command(flatten)]
    pub shadows: ShadowOptions,
    /// How to bake where the file stores no light.
    #[command(flatten)]
    pub bake: BakeOptions,
}

/// Which light is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Lighting {
    /// Straight from the lights.
    Direct,
    /// The same everywhere, as much as the stored light on average; nothing is baked for it.
    Ambient,
    /// All of the baked light.
    Radiosity,
    /// The indirect light of the bake, and direct light.
    #[value(name = "indirect+direct")]
    IndirectAndDirect,
}

/// Width and height in pixels; a type of its own, as clap takes an array for a repeated option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl RenderArgs {
    fn lighting(&self) -> Lighting {
        let default = match self.rays.renderer {
            RendererName::Raster => Lighting::Radiosity,
            RendererName::TwoPass | RendererName::Path => Lighting::IndirectAndDirect,
        };
        self.lighting.unwrap_or(default)
    }
}

/// Draws, writes and compares.
///
/// # Errors
/// The scene or the reference cannot be loaded, the scene cannot be baked, the picture cannot be written, or it
/// differs from the reference.
pub fn run(args: &RenderArgs, is_quiet: bool) -> Result<()> {
    // What can be refused at once is refused before the bake.
    FileKind::of(&args.output)?;
    if (args.shadows.shadows.is_some() || args.shadows.shadow_debug.is_some())
        && args.rays.renderer != RendererName::Raster
    {
        bail!("--shadows and --shadow-debug are for the raster renderer; rays find their own shadows");
    }
    let reference = args.reference.as_deref().map(Raster::load).transpose()?;
    let scene = load(&args.scene, &args.variant)?;
    if let Some(at) = &args.hemicube_at {
        return view_from_patch(scene, at, args, is_quiet);
    }
    let camera = args.eye.clone().map_or_else(|| choose_camera(&scene, args.camera.as_deref()), Ok)?;
    if let Some(techniques) = args.shadows.compared()? {
        let gpu = Gpu::headless()?;
        check_size(&gpu, args.size.0)?;
        return compare_shadows(&gpu, unbaked(scene), &camera, args.size.0, &techniques, &args.output);
    }
    let picture = match args.rays.renderer {
        RendererName::Raster => drawn(scene, &camera, args, is_quiet)?,
        RendererName::TwoPass => {
            let baked = first_pass(scene, args, is_quiet)?;
            let render_settings = render_settings(args, &baked);
            let film =
                args.rays.two_pass(&baked, &camera, args.size.0, args.lighting(), render_settings.ambient, is_quiet)?;
            develop(film.size(), film.radiance(), &render_settings)
        }
        RendererName::Path => {
            let film = args.rays.path_traced(&scene, &camera, args.size.0, args.lighting(), is_quiet)?;
            develop(
                film.size(),
                film.radiance(),
                &RenderSettings { exposure: args.exposure, ..RenderSettings::default() },
            )
        }
    };
    picture.save(&args.output)?;
    reference.map_or(Ok(()), |reference| judge(&picture, &reference, &args.output, args.threshold, is_quiet))
}

/// A picture drawn by the GPU.
fn drawn(scene: Scene, camera: &Camera, args: &RenderArgs, is_quiet: bool) -> Result<Picture> {
    let gpu = Gpu::headless()?;
    check_size(&gpu, args.size.0)?;
    let baked = light(&gpu, scene, args, is_quiet)?;
    Ok(picture(&gpu, &baked, camera, args.size.0, &render_settings(args, &baked))?)
}

/// The camera of that name, else of that number; without a wish the first, else one that sees everything.
fn choose_camera(scene: &Scene, wanted: Option<&str>) -> Result<Camera> {
    let Some(wanted) = wanted else {
        return Ok(scene.cameras.first().cloned().unwrap_or_else(|| Camera::framing(scene.bounds())));
    };
    let named = scene.cameras.iter().find(|camera| camera.name == wanted);
    let numbered = || wanted.parse::<usize>().ok().and_then(|index| scene.cameras.get(index));
    named.or_else(numbered).cloned().with_context(|| {
        let names: Vec<_> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
        format!("{} has no camera {wanted}; it has {} ({})", scene.name, names.len(), names.join(", "))
    })
}

/// The scene with the light that is to be shown.
pub(super) fn light(gpu: &Gpu, scene: Scene, args: &RenderArgs, is_quiet: bool) -> Result<BakedScene> {
    let needs_no_bake = match args.lighting() {
        Lighting::Ambient => true,
        Lighting::Direct => args.shadows.shadows.is_some(),
        Lighting::Radiosity | Lighting::IndirectAndDirect => false,
    };
    if needs_no_bake { Ok(unbaked(scene)) } else { lit_scene(Some(gpu), scene, &args.bake.settings(), is_quiet) }
}

/// The scene with the light that the second pass does not trace.
fn first_pass(scene: Scene, args: &RenderArgs, is_quiet: bool) -> Result<BakedScene> {
    match (baked::gltf::from_scene(scene), args.lighting()) {
        (Ok(baked), _) => Ok(baked),
        (Err(scene), Lighting::Direct | Lighting::Ambient) => Ok(BakedScene::dark(scene)),
        (Err(scene), _) => {
            let settings = args.bake.settings();
            lit_scene(bake_device(&settings)?.as_ref(), scene, &settings, is_quiet)
        }
    }
}

/// The scene with the light it stores, else with none.
fn unbaked(scene: Scene) -> BakedScene {
    baked::gltf::from_scene(scene).unwrap_or_else(BakedScene::dark)
}

pub(super) fn render_settings(args: &RenderArgs, baked: &BakedScene) -> RenderSettings {
    let all = RenderSettings {
        exposure: args.exposure,
        shadows: args.shadows.settings(),
        shadow_debug: args.shadows.debug(),
        ..RenderSettings::default()
    };
    // Ambient light takes the place of the stored light; shadows bring direct light of their own.
    let shadowed = f32::from(u8::from(all.shadows.is_some()));
    match args.lighting() {
        Lighting::Direct => RenderSettings { indirect: 0.0, ..all },
        Lighting::Ambient => {
            RenderSettings { direct: shadowed, indirect: 0.0, ambient: mean_radiance(&baked.light), ..all }
        }
        Lighting::Radiosity | Lighting::IndirectAndDirect => all,
    }
}

/// What white paint shows under the mean of the light; 1 in the dark.
fn mean_radiance(light: &VertexLight) -> Vec3 {
    let num_vertices = light.groups.first().map_or(0, |group| group.direct.len()).max(1);
    let total: Vec3 = light.groups.iter().flat_map(|group| group.direct.iter().chain(&group.indirect)).sum();
    if total == Vec3::ZERO { Vec3::ONE } else { total / (num_vertices as f32 * std::f32::consts::PI) }
}

fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides
        .filter(|sides| sides.iter().all(|&side| side > 0))
        .map(Size)
        .ok_or_else(|| "must look like 1280x720".to_owned())
}

/// Parses an eye.
fn eye(text: &str) -> Result<Camera, String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let numbers = numbers.and_then(|numbers| <[f32; 7]>::try_from(numbers).ok());
    let [x, y, z, dx, dy, dz, fov] = numbers
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()) && (1.0..=170.0).contains(&numbers[6]))
        .ok_or("must be seven numbers, X,Y,Z,DX,DY,DZ,FOV, FOV from 1 to 170")?;
    let (position, direction) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
    let direction = direction.try_normalize().filter(|d| d.xz() != Vec2::ZERO).ok_or("DX,DY,DZ must not be upright")?;
    Ok(Camera::looking_at("eye", position, position + direction, fov.to_radians()))
}

/// Parses an exposure value, or `auto`.
pub(super) fn exposure(text: &str) -> Result<Exposure, String> {
    match text.parse() {
        Ok(ev) if f32::abs(ev) <= 64.0 => Ok(Exposure::Ev(ev)),
        _ if text == "auto" => Ok(Exposure::Auto),
        _ => Err("must be auto or a number from -64 to 64".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_exposures_are_read_or_refused() {
        assert_eq!(size("640x360"), Ok(Size([640, 360])));
        for wrong in ["640", "0x10", "axb", "640x", "-1x5", "1x2x3"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(exposure("auto"), Ok(Exposure::Auto));
        assert_eq!(exposure("-7.5"), Ok(Exposure::Ev(-7.5)));
        for wrong in ["", "bright", "NaN", "inf", "1000"] {
            assert!(exposure(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_eye_is_read_or_refused() {
        let camera = eye("1,1.65,-2,0,0,-2,60").expect("seven numbers");
        assert_eq!(camera.position, Vec3::new(1.0, 1.65, -2.0));
        assert!((camera.forward() - Vec3::NEG_Z).length() < 1e-5);
        for wrong in ["", "1,2,3,0,0,-1", "1,2,3,0,0,-1,0", "1,2,3,0,1,0,60", "1,2,3,0,0,0,60", "a,2,3,0,0,-1,60"] {
            assert!(eye(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn cameras_go_by_name_then_by_number() {
        let camera = |name| Camera::looking_at(name, Vec3::Z, Vec3::ZERO, 1.0);
        let scene = Scene { cameras: vec![camera("door"), camera("0")], ..Scene::default() };
        let chosen = |wanted| choose_camera(&scene, wanted).map(|camera| camera.name);
        assert_eq!(chosen(None).expect("the first"), "door");
        assert_eq!(chosen(Some("0")).expect("by name"), "0");
        assert_eq!(chosen(Some("1")).expect("by number"), "0");
        let message = chosen(Some("attic")).expect_err("no such camera").to_string();
        assert!(message.contains("attic") && message.contains("door"), "{message}");
        assert_eq!(choose_camera(&Scene::default(), None).expect("an overview").name, "overview");
    }

    #[test]
    fn the_ambient_light_is_as_strong_as_the_mean() {
        let mut light = VertexLight::dark(2, 4);
        assert_eq!(mean_radiance(&light), Vec3::ONE);
        light.groups[1].indirect[2] = Vec3::splat(4.0 * std::f32::consts::PI);
        assert!((mean_radiance(&light) - Vec3::ONE).abs().max_element() < 1e-6);
    }
}
