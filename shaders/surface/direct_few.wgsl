// Surface pass: adds the direct light of up to four light samples, each with its shadow map or unshadowed. The
// bindings are written by src/render/shadow/few_lights.rs.

const MAX_LIGHTS: u32 = 4u;
// Properties of the lights. They are constants, because software drivers execute both sides of a branch.
override NUM_LIGHTS: u32 = 1u;
override HAS_MAPS: bool = true;
override KIND_0: u32 = 0u;
override KIND_1: u32 = 0u;
override KIND_2: u32 = 0u;
override KIND_3: u32 = 0u;
// True if a pixel has one sample, at its centre.
override ONE_SAMPLE: bool = false;

@group(3) @binding(0) var<uniform> lights: array<LightSample, MAX_LIGHTS>;
@group(3) @binding(1) var<uniform> shadow_maps: array<ShadowMap, MAX_LIGHTS>;
@group(3) @binding(2) var map_sampler: sampler;
// The maps of the lights. Those of missing lights are textures of one texel.
@group(3) @binding(3) var map_0: texture_depth_2d_array;
@group(3) @binding(4) var map_1: texture_depth_2d_array;
@group(3) @binding(5) var map_2: texture_depth_2d_array;
@group(3) @binding(6) var map_3: texture_depth_2d_array;
@group(3) @binding(7) var block_planes_0: texture_2d_array<f32>;
@group(3) @binding(8) var block_planes_1: texture_2d_array<f32>;
@group(3) @binding(9) var block_planes_2: texture_2d_array<f32>;
@group(3) @binding(10) var block_planes_3: texture_2d_array<f32>;

@vertex
fn vertex(in: Vertex) -> Varying {
    var out = surface_varying(in);
    out.point = in.position;
    out.normal = in.normal;
    out.middle_0 = position_in_light_space(lights[0], in.position);
    out.normal_0 = in_light_space(lights[0], in.normal);
    if NUM_LIGHTS > 1u {
        out.middle_1 = position_in_light_space(lights[1], in.position);
        out.normal_1 = in_light_space(lights[1], in.normal);
    }
    if NUM_LIGHTS > 2u {
        out.middle_2 = position_in_light_space(lights[2], in.position);
        out.normal_2 = in_light_space(lights[2], in.normal);
    }
    if NUM_LIGHTS > 3u {
        out.middle_3 = position_in_light_space(lights[3], in.position);
        out.normal_3 = in_light_space(lights[3], in.normal);
    }
    return out;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) is_front: bool) -> Shown {
    var direct = received(0u, KIND_0, map_0, block_planes_0, receiver(0u, KIND_0, in, is_front, in.middle_0, in.normal_0));
    if NUM_LIGHTS > 1u {
        direct += received(1u, KIND_1, map_1, block_planes_1, receiver(1u, KIND_1, in, is_front, in.middle_1, in.normal_1));
    }
    if NUM_LIGHTS > 2u {
        direct += received(2u, KIND_2, map_2, block_planes_2, receiver(2u, KIND_2, in, is_front, in.middle_2, in.normal_2));
    }
    if NUM_LIGHTS > 3u {
        direct += received(3u, KIND_3, map_3, block_planes_3, receiver(3u, KIND_3, in, is_front, in.middle_3, in.normal_3));
    }
    return surface_colour(in, is_front, direct);
}

// Returns the visible point in light space: at the centre of the pixel, or at the centroid if the centre can lie
// outside the triangle.
fn receiver(index: u32, kind: u32, in: Varying, is_front: bool, middle: vec3f, normal: vec3f) -> Receiver {
    if ONE_SAMPLE {
        let position = from_light(lights[index], kind, middle);
        return Receiver(position, facet_of(middle), seen_normal(normal, is_front));
    }
    let facet = facet_of(middle);
    let point = on_facet(position_in_light_space(lights[index], in.point), middle, facet);
    let shading_normal = in_light_space(lights[index], seen_normal(in.normal, is_front));
    return Receiver(from_light(lights[index], kind, point), facet, shading_normal);
}

fn received(
    index: u32,
    kind: u32,
    map: texture_depth_2d_array,
    block_planes: texture_2d_array<f32>,
    at: Receiver
) -> vec3f {
    let arrival = arrival(kind, at.from_light);
    let received = irradiance(lights[index], kind, arrival, at.normal);
    if !HAS_MAPS {
        return received;
    }
    return received * visible_share(any(received > vec3f(0.0)), kind, arrival, shadow_maps[index], map, block_planes, map_sampler, at);
}
