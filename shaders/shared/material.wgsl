// Bind group 2: numbers and textures of a material, and functions that evaluate them at a point. Written by
// src/render/scene/materials.rs. No branch depends on the numbers, and vertices pass them to their pixels, for the
// reasons in shared/frame.wgsl.

const NO_GROUP: u32 = 0xffffffffu;

// Alpha modes. Each has a pipeline of its own.
const ALPHA_OPAQUE: u32 = 0u;
const ALPHA_MASK: u32 = 1u;
const ALPHA_BLEND: u32 = 2u;
override ALPHA_MODE: u32 = ALPHA_OPAQUE;
// True if at least one texture is not white.
override HAS_TEXTURES: bool = true;
// True if the coverage of a mask is written as alpha, which smooths its edges. It needs several samples a pixel.
override ALPHA_TO_COVERAGE: bool = false;

// Coordinates of a texture: the rows of the affine map from mesh coordinates, and the coordinate set. If a material has
// no texture, a white one is bound.
struct Slot {
    u: vec3f,
    uv_set: u32,
    v: vec3f,
    padding: u32,
}

struct Material {
    base_colour: vec4f,
    emission: vec3f,
    metallic: f32,
    base_slot: Slot,
    metallic_slot: Slot,
    emissive_slot: Slot,
    alpha_cutoff: f32,
    // Index of the light group that dims the emission, or NO_GROUP.
    group: u32,
    padding: vec2u,
}

@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var base_texture: texture_2d<f32>;
@group(2) @binding(2) var base_sampler: sampler;
@group(2) @binding(3) var metallic_texture: texture_2d<f32>;
@group(2) @binding(4) var metallic_sampler: sampler;
@group(2) @binding(5) var emissive_texture: texture_2d<f32>;
@group(2) @binding(6) var emissive_sampler: sampler;

fn coordinate(slot: Slot, uv: vec4f) -> vec2f {
    if !HAS_TEXTURES {
        return vec2f(0.0);
    }
    let at = vec3f(select(uv.xy, uv.zw, slot.uv_set == 1u), 1.0);
    return vec2f(dot(slot.u, at), dot(slot.v, at));
}

// Returns colour and alpha of a point: the interpolated `factor` of its vertices times the texture at `place`.
fn base_colour(factor: vec4f, place: vec2f) -> vec4f {
    if !HAS_TEXTURES {
        return factor;
    }
    return factor * textureSample(base_texture, base_sampler, place);
}

// Returns the share of the pixel that the surface covers. Discards the holes of masks.
fn coverage(alpha: f32) -> f32 {
    if ALPHA_MODE == ALPHA_OPAQUE {
        return 1.0;
    }
    if ALPHA_MODE == ALPHA_BLEND {
        return saturate(alpha);
    }
    let above = alpha - material.alpha_cutoff;
    // A ramp one pixel wide round the cut-off (Golus 2017, "Anti-aliased Alpha Test").
    let ramp = saturate(above / max(fwidth(alpha), 1e-4) + 0.5);
    if select(above < 0.0, ramp <= 0.0, ALPHA_TO_COVERAGE) {
        discard;
    }
    return select(1.0, ramp, ALPHA_TO_COVERAGE);
}

fn metallic(factor: f32, place: vec2f) -> f32 {
    if !HAS_TEXTURES {
        return factor;
    }
    return factor * textureSample(metallic_texture, metallic_sampler, place).b;
}

// Returns the emission before its texture, dimmed with its light group.
fn emission_factor() -> vec3f {
    return material.emission * select(group_weight(material.group), vec3f(1.0), material.group == NO_GROUP);
}

fn emission(factor: vec3f, place: vec2f) -> vec3f {
    if !HAS_TEXTURES {
        return factor;
    }
    return factor * textureSample(emissive_texture, emissive_sampler, place).rgb;
}
