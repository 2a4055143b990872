// Surface pass: the radiance that leaves each visible point towards the eye.
//
//   L = emission + rho / pi x sum over groups of weight x (direct x E_direct + indirect x E_indirect)
//
// Irradiance E was summed over the groups at the vertices (shaders/weigh_groups.wgsl) and is interpolated; rho and
// emission are read per pixel, so textures stay sharp.

// What is shown, fixed when a pipeline is made.
const SHADING_LIT: u32 = 0u;
const SHADING_IRRADIANCE_ONLY: u32 = 1u;
const SHADING_ALBEDO: u32 = 2u;
const SHADING_NORMALS: u32 = 3u;
const SHADING_FALSE_COLOUR: u32 = 4u;
override SHADING: u32 = SHADING_LIT;

const PI: f32 = 3.14159265358979;
// Largest value that a half float holds, with room for rounding.
const LARGEST_HALF: f32 = 65000.0;
// Direct light comes from the lights themselves (shaders/direct_light.wgsl) and not from the vertices.
override LIT_BY_LIGHTS: bool = false;
// The target shows the radiance under the exposure of the frame, by this tone map; else it holds the radiance itself.
override DISPLAYS: bool = false;
override TONE_MAP: u32 = TONE_MAP_NEUTRAL;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
    // Irradiance, summed over the light groups.
    @location(4) direct: vec3f,
    @location(5) indirect: vec3f,
}

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) @interpolate(perspective, centroid) normal: vec3f,
    @location(1) colour: vec4f,
    // Both coordinate sets.
    @location(2) uv: vec4f,
    // Radiance of an ideal white surface; centroid, so that it is never extrapolated beyond the triangle.
    @location(3) @interpolate(perspective, centroid) white_radiance: vec3f,
    // Metres, world space; as in shared/visible_point.wgsl.
    @location(4) @interpolate(perspective, centroid) point: vec3f,
    @location(5) middle: vec3f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    var out: Varying;
    out.position = frame.projection_from_world * vec4f(in.position, 1.0);
    out.normal = in.normal;
    out.point = in.position;
    out.middle = in.position;
    out.colour = in.colour;
    out.uv = in.uv;
    // Surfaces that blend stay with the stored light.
    let direct = select(frame.direct, 0.0, LIT_BY_LIGHTS && ALPHA_MODE != ALPHA_BLEND);
    out.white_radiance = frame.ambient + (direct * in.direct + frame.indirect * in.indirect) / PI;
    return out;
}

// What the target is given of a fragment that receives `direct`, irradiance scaled by pre-exposure, beside the light of the
// vertices.
fn surface_colour(in: Varying, is_front: bool, direct: vec3f) -> vec4f {
    let base = base_colour(in.colour, in.uv);
    let coverage = coverage(base.a);
    var radiance = shade(in, base.rgb, is_front, direct);
    // The back of a single-sided surface blocks light and sends none.
    radiance = select(radiance, vec3f(0.0), !is_front & (material.double_sided == 0u));
    if DISPLAYS {
        return displayed(tone_mapped(radiance * frame.exposure, TONE_MAP), in.position.xy);
    }
    let stored = min(radiance * frame.pre_exposure, vec3f(LARGEST_HALF));
    // Blending is premultiplied; coverage of a mask acts through the samples instead.
    return vec4f(select(stored, stored * coverage, ALPHA_MODE == ALPHA_BLEND), coverage);
}

// What white paint shows of it.
fn direct_radiance(direct: vec3f) -> vec3f {
    if !LIT_BY_LIGHTS || ALPHA_MODE == ALPHA_BLEND {
        return vec3f(0.0);
    }
    return direct * (frame.direct * frame.live / (PI * frame.pre_exposure));
}

fn shade(in: Varying, base: vec3f, is_front: bool, direct: vec3f) -> vec3f {
    let metallic = metallic(in.uv);
    let emission = emission(in.uv);
    let light = max(in.white_radiance, vec3f(0.0)) + direct_radiance(direct);
    let reflectance = select(base * (1.0 - metallic), base, frame.metal_as_diffuse == 1u);
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
            return 0.5 + 0.5 * normalize(select(-in.normal, in.normal, is_front));
        }
        default: {
            return select(emission + reflectance * light, base, material.unlit == 1u);
        }
    }
}
