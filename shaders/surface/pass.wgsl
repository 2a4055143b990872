// Surface pass: the radiance that leaves each visible point towards the eye.
//
//   L = emission + rho x (ambient + 1 / pi x sum over groups of weight x (direct x E_direct + indirect x E_indirect))
//
// Irradiance E is summed over the groups at the vertices (shaders/stored_light/weighted_light.wgsl) and interpolated.
// rho and emission are read for each pixel, so textures stay sharp. Whatever is linear in a triangle is computed at its
// vertices.

// Quantity that is shown of surfaces. Each value has a pipeline of its own.
const SHADING_LIT: u32 = 0u;
const SHADING_IRRADIANCE_ONLY: u32 = 1u;
const SHADING_ALBEDO: u32 = 2u;
const SHADING_NORMALS: u32 = 3u;
const SHADING_FALSE_COLOUR: u32 = 4u;
override SHADING: u32 = SHADING_LIT;

const PI: f32 = 3.14159265358979;
// Largest value that a half float holds, with room for rounding.
const LARGEST_HALF: f32 = 65000.0;
// True if direct light comes from the lights themselves and not from the vertices.
override LIT_BY_LIGHTS: bool = false;
// True if the target receives display colours: exposed by the given or the last metered exposure, then mapped by
// TONE_MAP. Otherwise it receives radiance.
override DISPLAYS: bool = false;
override TONE_MAP: u32 = TONE_MAP_NEUTRAL;
// True if the back of the surface is drawn black: a single-sided surface blocks light and sends none from behind.
override HAS_DARK_BACK: bool = false;
// True if the base colour is shown without light (KHR_materials_unlit).
override IS_UNLIT: bool = false;
// True if metals reflect their base colour diffusely.
override METAL_AS_DIFFUSE: bool = true;

@group(1) @binding(0) var<storage, read> metered_exposure: f32;
// Light of the vertices in tiles (shaders/stored_light/light_tiles.wgsl); a placeholder texture if the light is not in
// tiles.
@group(1) @binding(1) var tiles: texture_2d<f32>;
@group(1) @binding(2) var between_texels: sampler;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
    // Direct and indirect irradiance, summed over the light groups. If light is in tiles, the two hold coordinates in
    // the tile (0..1) and the first texel and the width of the tile, as shares of the texture.
    @location(4) direct: vec3f,
    @location(5) indirect: vec3f,
}

// Returns what the vertices of every surface pass to its pixels.
fn surface_varying(in: Vertex) -> Varying {
    var out: Varying;
    out.position = frame.projection_from_world * vec4f(in.position, 1.0);
    out.colour = material.base_colour * in.colour;
    out.base_and_metallic_uv = vec4f(coordinate(material.base_slot, in.uv), coordinate(material.metallic_slot, in.uv));
    let tile_width = select(0.0, in.indirect.y, IS_TILED);
    out.emissive_uv_and_scales = vec4f(coordinate(material.emissive_slot, in.uv), target_scale(), tile_width);
    out.light = handed_light(in);
    out.emission_and_metallic = vec4f(light_scale() * emission_factor(), material.metallic);
    return out;
}

// Returns the radiance of white paint, or the place of the light in a tile, or the normal if normals are shown. They
// share a location because a software driver writes every location.
fn handed_light(in: Vertex) -> vec4f {
    if SHADING == SHADING_NORMALS {
        return vec4f(in.normal, 0.0);
    }
    if IS_TILED {
        return vec4f(in.direct, in.indirect.x);
    }
    // Surfaces that blend always show the stored light.
    let direct = select(frame.direct, 0.0, LIT_BY_LIGHTS && ALPHA_MODE != ALPHA_BLEND);
    let irradiance = direct * in.direct + frame.indirect * in.indirect;
    return vec4f(light_scale() * (frame.ambient + irradiance / PI), 0.0);
}

// Returns the factor on shaded colours: pre-exposure if they are light, else 1.
fn light_scale() -> f32 {
    return select(1.0, frame.pre_exposure, shows_light());
}

fn shows_light() -> bool {
    return SHADING == SHADING_LIT || SHADING == SHADING_IRRADIANCE_ONLY;
}

// Returns the factor from shaded colours to the values of the target.
fn target_scale() -> f32 {
    let exposure = select(metered_exposure, frame.exposure, frame.exposure > 0.0);
    let scale = select(frame.pre_exposure, exposure, DISPLAYS);
    return select(scale, scale / frame.pre_exposure, shows_light());
}

struct Shown {
    @location(0) colour: vec4f,
    // For the light meter: luminance scaled by pre-exposure.
    @location(1) luminance: f32,
}

// Returns the values of the targets. The fragment receives `direct`, irradiance scaled by pre-exposure, in addition to
// the light of the vertices.
fn surface_colour(in: Varying, is_front: bool, direct: vec3f) -> Shown {
    let base = base_colour(in.colour, in.base_and_metallic_uv.xy);
    let coverage = coverage(base.a);
    var shown = shade(in, base.rgb, is_front, direct);
    if HAS_DARK_BACK {
        shown = select(vec3f(0.0), shown, is_front);
    }
    let scaled = shown * in.emissive_uv_and_scales.z;
    if DISPLAYS {
        let displayed = displayed(tone_mapped(scaled, TONE_MAP), in.position.xy);
        return Shown(displayed, min(luminance(shown), LARGEST_HALF));
    }
    let stored = min(scaled, vec3f(LARGEST_HALF));
    // Blending is premultiplied. A mask is not: its coverage selects samples instead.
    return Shown(vec4f(select(stored, stored * coverage, ALPHA_MODE == ALPHA_BLEND), coverage), 0.0);
}

// Returns the radiance of white paint under the light of the vertices.
fn stored_radiance(in: Varying) -> vec3f {
    if !IS_TILED {
        return max(in.light.rgb, vec3f(0.0));
    }
    // The centre of a pixel on an edge may lie beside the triangle, where another tile begins.
    let clamped = clamp(in.light.xy, vec2f(0.0), vec2f(1.0));
    let place = clamped - 0.5 * max(clamped.x + clamped.y - 1.0, 0.0);
    let texel = in.light.zw + in.emissive_uv_and_scales.w * place;
    let radiance = max(textureSampleLevel(tiles, between_texels, texel, 0.0).rgb, vec3f(0.0));
    return select(radiance / frame.pre_exposure, radiance, shows_light());
}

// Returns the radiance of white paint under the light of the lights themselves.
fn direct_radiance(direct: vec3f) -> vec3f {
    if !LIT_BY_LIGHTS || ALPHA_MODE == ALPHA_BLEND {
        return vec3f(0.0);
    }
    if SHADING == SHADING_FALSE_COLOUR {
        return direct * (frame.live / frame.pre_exposure);
    }
    return direct * frame.live;
}

// Returns the colour of the fragment. Light is scaled by pre-exposure.
fn shade(in: Varying, base: vec3f, is_front: bool, direct: vec3f) -> vec3f {
    let metallic = metallic(in.emission_and_metallic.w, in.base_and_metallic_uv.zw);
    let emission = emission(in.emission_and_metallic.xyz, in.emissive_uv_and_scales.xy);
    let light = stored_radiance(in) + direct_radiance(direct);
    let reflectance = select(base * (1.0 - metallic), base, METAL_AS_DIFFUSE);
    switch SHADING {
        case SHADING_IRRADIANCE_ONLY: {
            return light;
        }
        case SHADING_FALSE_COLOUR: {
            return false_colour(luminance(light) * PI);
        }
        case SHADING_ALBEDO: {
            return reflectance;
        }
        case SHADING_NORMALS: {
            return 0.5 + 0.5 * normalize(select(-in.light.xyz, in.light.xyz, is_front));
        }
        default: {
            return select(emission + reflectance * light, frame.pre_exposure * base, IS_UNLIT);
        }
    }
}
