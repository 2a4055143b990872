// Surface pass: the radiance that leaves each visible point towards the eye.
//
//   L = emission + rho / pi x sum over groups of weight x (direct x E_direct + indirect x E_indirect)
//
// Irradiance E is summed at the vertices and interpolated; rho and emission are read per pixel, so textures stay sharp.

const PI: f32 = 3.14159265358979;
// Largest value that a half float holds, with room for rounding.
const LARGEST_HALF: f32 = 65000.0;
const NO_GROUP: u32 = 0xffffffffu;

// How alpha acts; one pipeline each.
const ALPHA_OPAQUE: u32 = 0u;
const ALPHA_MASK: u32 = 1u;
const ALPHA_BLEND: u32 = 2u;
override ALPHA_MODE: u32 = ALPHA_OPAQUE;
// Masked edges are softened by coverage (needs several samples a pixel).
override ALPHA_TO_COVERAGE: bool = false;

// Where a texture is read: rows of the affine map from mesh coordinates, the coordinate set, and whether there is one.
struct Slot {
    u: vec3f,
    uv_set: u32,
    v: vec3f,
    is_used: u32,
}

struct Material {
    base_colour: vec4f,
    emission: vec3f,
    metallic: f32,
    base_slot: Slot,
    metallic_slot: Slot,
    emissive_slot: Slot,
    alpha_cutoff: f32,
    // Light group that dims the emission, or NO_GROUP.
    group: u32,
    double_sided: u32,
    unlit: u32,
}

// Irradiance of the vertices: [2 x group + (0 direct, 1 indirect)][vertex], three floats each.
@group(1) @binding(0) var<storage, read> irradiance: array<f32>;

@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var base_texture: texture_2d<f32>;
@group(2) @binding(2) var base_sampler: sampler;
@group(2) @binding(3) var metallic_texture: texture_2d<f32>;
@group(2) @binding(4) var metallic_sampler: sampler;
@group(2) @binding(5) var emissive_texture: texture_2d<f32>;
@group(2) @binding(6) var emissive_sampler: sampler;

struct Vertex {
    @builtin(vertex_index) index: u32,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
}

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) normal: vec3f,
    @location(1) colour: vec4f,
    // Both coordinate sets.
    @location(2) uv: vec4f,
    // Radiance of an ideal white surface; centroid, so that it is never extrapolated beyond the triangle.
    @location(3) @interpolate(perspective, centroid) white_radiance: vec3f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    var out: Varying;
    out.position = frame.projection_from_world * vec4f(in.position, 1.0);
    out.normal = in.normal;
    out.colour = in.colour;
    out.uv = in.uv;
    out.white_radiance = frame.ambient + vertex_irradiance(in.index) / PI;
    return out;
}

fn vertex_irradiance(index: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var group = 0u; group < frame.num_groups; group++) {
        let weight = group_weight(group);
        sum += weight * frame.direct * stored_irradiance(2u * group, index);
        sum += weight * frame.indirect * stored_irradiance(2u * group + 1u, index);
    }
    return sum;
}

fn group_weight(group: u32) -> vec3f {
    return frame.group_weights[min(group, MAX_GROUPS - 1u)].rgb;
}

fn stored_irradiance(part: u32, index: u32) -> vec3f {
    let at = 3u * (part * frame.num_vertices + index);
    return vec3f(irradiance[at], irradiance[at + 1u], irradiance[at + 2u]);
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let base = base_colour(in);
    let coverage = coverage(base.a);
    var radiance = shade(in, base.rgb, is_front);
    // The back of a single-sided surface blocks light and sends none.
    if !is_front && material.double_sided == 0u {
        radiance = vec3f(0.0);
    }
    let stored = min(radiance * frame.pre_exposure, vec3f(LARGEST_HALF));
    // Blending is premultiplied; coverage of a mask acts through the samples instead.
    return vec4f(select(stored, stored * coverage, ALPHA_MODE == ALPHA_BLEND), coverage);
}

fn coordinate(slot: Slot, uv: vec4f) -> vec2f {
    let at = vec3f(select(uv.xy, uv.zw, slot.uv_set == 1u), 1.0);
    return vec2f(dot(slot.u, at), dot(slot.v, at));
}

fn base_colour(in: Varying) -> vec4f {
    let factor = material.base_colour * in.colour;
    if material.base_slot.is_used == 0u {
        return factor;
    }
    return factor * textureSample(base_texture, base_sampler, coordinate(material.base_slot, in.uv));
}

// Share of the pixel that the surface fills.
fn coverage(alpha: f32) -> f32 {
    if ALPHA_MODE == ALPHA_OPAQUE {
        return 1.0;
    }
    if ALPHA_MODE == ALPHA_BLEND {
        return saturate(alpha);
    }
    let above = alpha - material.alpha_cutoff;
    // One pixel wide ramp round the cut-off (Golus 2017, "Anti-aliased Alpha Test").
    let ramp = saturate(above / max(fwidth(alpha), 1e-4) + 0.5);
    if select(above < 0.0, ramp <= 0.0, ALPHA_TO_COVERAGE) {
        discard;
    }
    return select(1.0, ramp, ALPHA_TO_COVERAGE);
}

fn shade(in: Varying, base: vec3f, is_front: bool) -> vec3f {
    let metallic = metallic(in);
    let emission = emission(in);
    let light = max(in.white_radiance, vec3f(0.0));
    let reflectance = select(base * (1.0 - metallic), base, frame.metal_as_diffuse == 1u);
    switch frame.shading {
        case SHADING_IRRADIANCE_ONLY: {
            return light;
        }
        case SHADING_ALBEDO: {
            return reflectance;
        }
        case SHADING_NORMALS: {
            return 0.5 + 0.5 * normalize(select(-in.normal, in.normal, is_front));
        }
        default: {
            return select(emission + reflectance * light, base, material.unlit == 1u);
        }
    }
}

fn metallic(in: Varying) -> f32 {
    if material.metallic_slot.is_used == 0u {
        return material.metallic;
    }
    return material.metallic * textureSample(metallic_texture, metallic_sampler, coordinate(material.metallic_slot, in.uv)).b;
}

fn emission(in: Varying) -> vec3f {
    var emitted = material.emission;
    if material.group != NO_GROUP {
        emitted *= group_weight(material.group);
    }
    if material.emissive_slot.is_used == 0u {
        return emitted;
    }
    return emitted * textureSample(emissive_texture, emissive_sampler, coordinate(material.emissive_slot, in.uv)).rgb;
}
