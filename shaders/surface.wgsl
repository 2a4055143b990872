// Surface pass: the radiance that leaves each visible point towards the eye.
//
//   L = emission + rho / pi x sum over groups of weight x (direct x E_direct + indirect x E_indirect)
//
// Irradiance E was summed over the groups at the vertices (shaders/weigh_groups.wgsl) and is interpolated; rho and
// emission are read per pixel, so textures stay sharp. What is linear in a triangle is found at its vertices.

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
// The back of a single-sided surface blocks light and sends none.
override HAS_DARK_BACK: bool = false;
// The base colour is shown as it is.
override IS_UNLIT: bool = false;
// Metals reflect their base colour diffusely.
override METAL_AS_DIFFUSE: bool = true;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
    // Irradiance, summed over the light groups.
    @location(4) direct: vec3f,
    @location(5) indirect: vec3f,
}

// What every surface hands to its pixels.
fn surface_varying(in: Vertex) -> Varying {
    var out: Varying;
    out.position = frame.projection_from_world * vec4f(in.position, 1.0);
    out.normal = in.normal;
    out.colour = material.base_colour * in.colour;
    out.base_and_metallic_uv = vec4f(coordinate(material.base_slot, in.uv), coordinate(material.metallic_slot, in.uv));
    out.emissive_uv = coordinate(material.emissive_slot, in.uv);
    let scale = light_scale();
    // Surfaces that blend stay with the stored light.
    let direct = select(frame.direct, 0.0, LIT_BY_LIGHTS && ALPHA_MODE != ALPHA_BLEND);
    out.white_radiance = scale * (frame.ambient + (direct * in.direct + frame.indirect * in.indirect) / PI);
    out.emission_and_metallic = vec4f(scale * emission_factor(), material.metallic);
    return out;
}

// Light is scaled as the target holds it, other things stay as they are.
fn light_scale() -> f32 {
    return select(1.0, target_scale(), SHADING == SHADING_LIT || SHADING == SHADING_IRRADIANCE_ONLY);
}

fn target_scale() -> f32 {
    return select(frame.pre_exposure, frame.exposure, DISPLAYS);
}

// What the target is given of a fragment that receives `direct`, irradiance scaled by pre-exposure, beside the light of the
// vertices.
fn surface_colour(in: Varying, is_front: bool, direct: vec3f) -> vec4f {
    let base = base_colour(in.colour, in.base_and_metallic_uv.xy);
    let coverage = coverage(base.a);
    var shown = shade(in, base.rgb, is_front, direct);
    if HAS_DARK_BACK {
        shown = select(vec3f(0.0), shown, is_front);
    }
    if DISPLAYS {
        return displayed(tone_mapped(shown, TONE_MAP), in.position.xy);
    }
    let stored = min(shown, vec3f(LARGEST_HALF));
    // Blending is premultiplied; coverage of a mask acts through the samples instead.
    return vec4f(select(stored, stored * coverage, ALPHA_MODE == ALPHA_BLEND), coverage);
}

// What white paint shows of it.
fn direct_radiance(direct: vec3f) -> vec3f {
    if !LIT_BY_LIGHTS || ALPHA_MODE == ALPHA_BLEND {
        return vec3f(0.0);
    }
    if SHADING == SHADING_FALSE_COLOUR {
        return direct * (frame.live / frame.pre_exposure);
    }
    return direct * select(frame.live, frame.live_displayed, DISPLAYS);
}

// Scaled as the target holds it.
fn shade(in: Varying, base: vec3f, is_front: bool, direct: vec3f) -> vec3f {
    let metallic = metallic(in.emission_and_metallic.w, in.base_and_metallic_uv.zw);
    let emission = emission(in.emission_and_metallic.xyz, in.emissive_uv);
    let light = max(in.white_radiance, vec3f(0.0)) + direct_radiance(direct);
    let reflectance = select(base * (1.0 - metallic), base, METAL_AS_DIFFUSE);
    switch SHADING {
        case SHADING_IRRADIANCE_ONLY: {
            return light;
        }
        case SHADING_FALSE_COLOUR: {
            return target_scale() * false_colour(luminance(light) * PI);
        }
        case SHADING_ALBEDO: {
            return target_scale() * reflectance;
        }
        case SHADING_NORMALS: {
            return target_scale() * (0.5 + 0.5 * normalize(select(-in.normal, in.normal, is_front)));
        }
        default: {
            return select(emission + reflectance * light, target_scale() * base, IS_UNLIT);
        }
    }
}
