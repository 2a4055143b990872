//! Every shader of the program, stitched from its parts.
//!
//! There is no preprocessor: an entry is a list of files laid end to end, variants are pipeline `override` constants.
//! Under a debug switch of the viewer the same files are read from disk again (F5).

/// A complete WGSL module and the files it is made of.
pub struct Shader {
    /// Stem of its main file, the label of its module.
    pub name: &'static str,
    /// (file name below `shaders/`, text built in), laid end to end.
    pub parts: &'static [(&'static str, &'static str)],
}

macro_rules! shader {
    ($name:literal, $($file:literal),+) => {
        Shader { name: $name, parts: &[$(($file, include_str!(concat!("../../shaders/", $file)))),+] }
    };
}

/// Item buffer: element ids seen from a hemicube.
pub const ITEM_BUFFER: Shader = shader!("item_buffer", "item_buffer.wgsl");

/// Surface pass: radiance of each visible point.
pub const SURFACE: Shader = shader!(
    "surface",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/varying.wgsl",
    "surface.wgsl",
    "shared/direct_stored.wgsl"
);
/// Surface pass with the light of the vertices in tiles.
pub const SURFACE_TILES: Shader = shader!(
    "surface, tiles",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/varying_tiles.wgsl",
    "surface.wgsl",
    "shared/direct_stored.wgsl"
);
/// Surface pass with direct irradiance from a texture with one sample a pixel.
pub const SURFACE_LIT: Shader = shader!(
    "surface lit",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/varying.wgsl",
    "surface.wgsl",
    "shared/direct_one.wgsl"
);
/// Surface pass with direct irradiance from a texture with several samples a pixel.
pub const SURFACE_LIT_SAMPLES: Shader = shader!(
    "surface lit samples",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/varying.wgsl",
    "surface.wgsl",
    "shared/direct_many.wgsl"
);
/// Surface pass with the direct light of a few light samples.
pub const SURFACE_FEW_LIGHTS: Shader = shader!(
    "surface few lights",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/varying_few.wgsl",
    "surface.wgsl",
    "shared/direct_few.wgsl"
);
/// The same with the light of the vertices in tiles.
pub const SURFACE_FEW_LIGHTS_TILES: Shader = shader!(
    "surface few lights, tiles",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/false_colour.wgsl",
    "shared/material.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/varying_few_tiles.wgsl",
    "surface.wgsl",
    "shared/direct_few.wgsl"
);
/// Light of the vertices summed over the light groups.
pub const WEIGH_GROUPS: Shader = shader!("weigh groups", "shared/frame.wgsl", "weigh_groups.wgsl");
/// Light of the vertices spread over the tiles of a coarse mesh.
pub const FILL_TILES: Shader = shader!("fill tiles", "shared/frame.wgsl", "fill_tiles.wgsl");
/// Depth of the visible surfaces.
pub const DEPTH_PREPASS: Shader =
    shader!("depth prepass", "shared/frame.wgsl", "shared/material.wgsl", "depth_prepass.wgsl");
/// Direct light of one sample where the stencil lets it pass.
pub const DIRECT_LIGHT: Shader = shader!(
    "direct light",
    "shared/frame.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/lit_point.wgsl",
    "shared/visibility_stencil.wgsl",
    "direct_light.wgsl"
);
/// Counts shadow volumes in the stencil.
pub const SHADOW_VOLUME: Shader = shader!(
    "shadow volume",
    "shared/frame.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shadow_volume.wgsl"
);
/// Marks what lies behind casters with holes.
pub const CUTOUT_SHADOW: Shader = shader!(
    "cut-out shadow",
    "shared/frame.wgsl",
    "shared/material.wgsl",
    "shared/visible_point.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "cutout_shadow.wgsl"
);
/// Depth as a light sees it.
pub const SHADOW_MAP: Shader = shader!("shadow map", "shared/frame.wgsl", "shared/material.wgsl", "shadow_map.wgsl");
/// Planes that blocks of a shadow map show.
pub const MAP_OVERVIEW: Shader = shader!("map overview", "shared/shadow_map.wgsl", "map_overview.wgsl");
/// Direct light of one sample where its shadow map sees the point.
pub const DIRECT_LIGHT_MAP: Shader = shader!(
    "direct light, map",
    "shared/frame.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/lit_point.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/visibility_map.wgsl",
    "direct_light.wgsl"
);
/// Receivers, and casters flattened on to them.
pub const PLANAR_SHADOW: Shader = shader!("planar shadow", "shared/frame.wgsl", "planar_shadow.wgsl");
/// Places and normals of visible points.
pub const VISIBLE_POINTS: Shader =
    shader!("visible points", "shared/frame.wgsl", "shared/visible_point.wgsl", "shared/facet.wgsl", "raytraced.wgsl");
/// Lines and tinted faces over a picture.
pub const OVERLAY: Shader = shader!("overlay", "shared/frame.wgsl", "shared/colour.wgsl", "overlay.wgsl");
/// What the stencil counts, in colours over a picture.
pub const STENCIL_COUNTS: Shader = shader!(
    "stencil counts",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/false_colour.wgsl",
    "stencil_counts.wgsl"
);
/// Depth in the faces of a shadow map.
pub const MAP_FACES: Shader = shader!(
    "map faces",
    "shared/colour.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/visibility_map.wgsl",
    "map_faces.wgsl"
);
/// Metering: the exposure that suits a picture.
pub const METER: Shader = shader!("meter", "shared/frame.wgsl", "shared/colour.wgsl", "meter.wgsl");
/// Tone mapping of a picture with one sample a pixel.
pub const TONEMAP: Shader = shader!(
    "tonemap",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/samples_one.wgsl",
    "tonemap.wgsl"
);
/// Tone mapping of a picture with several samples a pixel.
pub const TONEMAP_SAMPLES: Shader = shader!(
    "tonemap samples",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "shared/display.wgsl",
    "shared/samples_many.wgsl",
    "tonemap.wgsl"
);

/// All shaders, for the test that validates each and for reloading.
pub const ALL: &[&Shader] = &[
    &ITEM_BUFFER,
    &SURFACE,
    &SURFACE_TILES,
    &SURFACE_LIT,
    &SURFACE_LIT_SAMPLES,
    &SURFACE_FEW_LIGHTS,
    &SURFACE_FEW_LIGHTS_TILES,
    &WEIGH_GROUPS,
    &FILL_TILES,
    &DEPTH_PREPASS,
    &DIRECT_LIGHT,
    &SHADOW_VOLUME,
    &CUTOUT_SHADOW,
    &SHADOW_MAP,
    &MAP_OVERVIEW,
    &DIRECT_LIGHT_MAP,
    &PLANAR_SHADOW,
    &VISIBLE_POINTS,
    &OVERLAY,
    &STENCIL_COUNTS,
    &MAP_FACES,
    &METER,
    &TONEMAP,
    &TONEMAP_SAMPLES,
];

impl Shader {
    /// The WGSL text.
    #[must_use]
    pub fn source(&self) -> String {
        self.parts.iter().map(|(_, text)| *text).collect::<Vec<_>>().join("\n")
    }

    /// Compiles the built-in text.
    #[must_use]
    pub fn module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.source().into()),
        })
    }
}

/// Parses and validates WGSL; the error is naga's own message with the place marked.
///
/// # Errors
/// The text is no valid module.
pub fn validate(source: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    Ok(())
}

/// Byte offsets of the members of a WGSL struct and its size, to hold Rust structs against.
#[cfg(test)]
pub fn struct_layout(shader: &Shader, name: &str) -> Vec<usize> {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).expect("the struct is there");
    let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is no struct") };
    members.iter().map(|member| member.offset).chain([*span]).map(|offset| offset as usize).collect()
}

/// A whole number of a WGSL module, to hold Rust constants against.
#[cfg(test)]
pub fn constant(shader: &Shader, name: &str) -> u32 {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) =
        module.constants.iter().find(|(_, known)| known.name.as_deref() == Some(name)).expect("it is there");
    match module.global_expressions[found.init] {
        naga::Expression::Literal(naga::Literal::U32(value)) => value,
        _ => panic!("{name} is no whole number"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_is_valid() {
        for shader in ALL {
            if let Err(message) = validate(&shader.source()) {
                panic!("{}: {message}", shader.name);
            }
        }
    }

    #[test]
    fn a_broken_shader_is_refused_with_its_place() {
        let message = validate("@fragment fn main() -> u32 { return 1.5; }").unwrap_err();
        assert!(message.contains("1:"), "{message}");
    }
}
