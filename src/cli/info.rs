//! `hemicube info`: prints the contents of a scene and the findings of the mesh doctor.

use std::fmt::{self, Write as _};
use std::io::{ErrorKind, Write as _};
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::scene_input::{VariantOption, load};
use crate::bake::{BakeSettings, Forecast, Quality};
use crate::base::colour::luminance;
use crate::scene::{Camera, Light, LightKind, Projection, Scene, doctor};

/// Options of `hemicube info`.
#[derive(Args, Debug)]
pub struct InfoArgs {
    /// Scene to describe: .glb or .gltf; FILE#NAME chooses one of its scenes.
    pub scene: PathBuf,
    /// Material variant of the file.
    #[command(flatten)]
    pub variant: VariantOption,
}

/// Prints the report on stdout.
///
/// # Errors
/// Returns an error if the scene cannot be loaded.
pub fn run(args: &InfoArgs) -> Result<()> {
    let scene = load(&args.scene, &args.variant)?;
    let mut text = String::new();
    write_report(&mut text, &scene)?;
    match std::io::stdout().write_all(text.as_bytes()) {
        // The reader may close the pipe early, for example in `hemicube info X | head`.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}

fn write_report(out: &mut String, scene: &Scene) -> fmt::Result {
    let bounds = scene.bounds();
    let size = bounds.size();
    writeln!(out, "{}", scene.name)?;
    row(out, "triangles", scene.triangles.len())?;
    row(out, "vertices", scene.vertices.len())?;
    row(out, "instances", scene.instances.len())?;
    row(out, "materials", scene.materials.len())?;
    row(out, "textures", scene.textures.len())?;
    if !scene.triangles.is_empty() {
        row(out, "size", format_args!("{:.3} x {:.3} x {:.3} m (x, y up, z)", size.x, size.y, size.z))?;
        row(out, "bounds", format_args!("{:.3} to {:.3}", bounds.low, bounds.high))?;
        row(out, "area", format_args!("{:.3} m2", scene.area()))?;
    }
    section(out, "lights", scene.lights.iter().map(|light| (light.name.clone(), describe_light(light))))?;
    section(out, "emissive materials", emitters(scene))?;
    let groups = scene.light_groups.iter().enumerate().map(|(g, name)| (g.to_string(), name.clone()));
    section(out, "light groups", groups)?;
    let variants = scene.variants.iter().enumerate().map(|(v, name)| (v.to_string(), name.clone()));
    section(out, "variants", variants)?;
    section(out, "cameras", scene.cameras.iter().map(|camera| (camera.name.clone(), describe_camera(camera))))?;
    let stored = scene.irradiance.iter().map(|stored| (stored.name.clone(), format!("{} values", stored.values.len())));
    section(out, "stored light", stored)?;
    section(out, "bake", forecasts(scene))?;
    list(out, "notes", &scene.notes)?;
    list(out, "mesh doctor", &doctor::examine(scene).lines())
}

/// Returns the predicted cost of a bake with each preset.
fn forecasts(scene: &Scene) -> impl Iterator<Item = (String, String)> {
    Quality::ALL.into_iter().filter_map(|quality| {
        let Forecast { elements, patches, vertices, bytes } =
            Forecast::of(scene, &BakeSettings::preset(quality)).ok()?;
        let mib = bytes >> 20;
        let counts = format!("{elements} elements, {patches} patches, {vertices} vertices");
        Some((quality.name().to_owned(), format!("{counts}, more where light changes; about {mib} MiB")))
    })
}

fn row(out: &mut String, label: &str, value: impl fmt::Display) -> fmt::Result {
    writeln!(out, "  {label:<12}{value}")
}

/// Writes a heading and aligned pairs; nothing if there are no pairs.
fn section(out: &mut String, title: &str, pairs: impl Iterator<Item = (String, String)>) -> fmt::Result {
    let pairs: Vec<_> = pairs.collect();
    let width = pairs.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(10);
    if !pairs.is_empty() {
        writeln!(out, "{title}")?;
    }
    pairs.iter().try_for_each(|(name, text)| writeln!(out, "  {name:<width$}  {text}"))
}

fn list(out: &mut String, title: &str, lines: &[String]) -> fmt::Result {
    if !lines.is_empty() {
        writeln!(out, "{title}")?;
    }
    lines.iter().try_for_each(|line| writeln!(out, "  - {line}"))
}

fn describe_light(light: &Light) -> String {
    let amount = luminance(light.intensity);
    let range = light.range.map_or_else(String::new, |range| format!(", range {range} m"));
    match light.kind {
        LightKind::Point { position } => {
            let kind = if light.profile.is_some() { "photometric" } else { "point" };
            format!("{kind:<12} {amount:>10.2} cd  at {position:.2}{range}")
        }
        LightKind::Spot { position, direction, inner_angle, outer_angle } => {
            let (inner, outer) = (inner_angle.to_degrees(), outer_angle.to_degrees());
            format!(
                "spot         {amount:>10.2} cd  at {position:.2} towards {direction:.2}, cone {inner:.1} to {outer:.1} deg{range}"
            )
        }
        LightKind::Directional { direction } => format!("directional  {amount:>10.2} lx  towards {direction:.2}"),
    }
}

fn emitters(scene: &Scene) -> impl Iterator<Item = (String, String)> {
    let in_use = scene.materials.iter().filter(|material| material.group.is_some());
    in_use.map(|material| {
        let textured = if material.emissive_texture.is_some() { " x texture" } else { "" };
        (material.name.clone(), format!("{:>10.2} nit{textured}", luminance(material.emission)))
    })
}

fn describe_camera(camera: &Camera) -> String {
    let projection = match camera.projection {
        Projection::Perspective { fov_y } => format!("perspective, {:.1} deg high", fov_y.to_degrees()),
        Projection::Orthographic { half_height } => format!("orthographic, {:.2} m high", 2.0 * half_height),
    };
    format!("{projection}, at {:.2} looking along {:.2}", camera.position, camera.forward())
}
