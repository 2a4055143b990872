// Surface pass: direct light of a few light samples, each in the shadows of its map. Written by
// src/render/shadow/few_lights.rs.

const MAX_LIGHTS: u32 = 4u;
// What they are like: software drivers go through both sides of every branch.
override NUM_LIGHTS: u32 = 1u;
override HAS_MAPS: bool = true;
override IS_CUBE_0: bool = false;
override IS_CUBE_1: bool = false;
override IS_CUBE_2: bool = false;
override IS_CUBE_3: bool = false;
// One sample a pixel, which lies in its middle.
override ONE_SAMPLE: bool = false;

@group(3) @binding(0) var<uniform> lights: array<LightSample, MAX_LIGHTS>;
@group(3) @binding(1) var<uniform> shadow_maps: array<ShadowMap, MAX_LIGHTS>;
@group(3) @binding(2) var map_sampler: sampler;
// Bound more than once where there are fewer.
@group(3) @binding(3) var map_0: texture_depth_2d_array;
@group(3) @binding(4) var map_1: texture_depth_2d_array;
@group(3) @binding(5) var map_2: texture_depth_2d_array;
@group(3) @binding(6) var map_3: texture_depth_2d_array;

@fragment
fn fragment(in: Varying, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let facet = facet_normal(in.middle);
    var at: Receiver;
    at.point = in.middle;
    if !ONE_SAMPLE {
        at.point = on_facet(in.point, in.middle, facet);
    }
    at.facet = facet;
    at.normal = seen_normal(in.normal, is_front);
    var direct = received(0u, map_0, IS_CUBE_0, at);
    if NUM_LIGHTS > 1u {
        direct += received(1u, map_1, IS_CUBE_1, at);
    }
    if NUM_LIGHTS > 2u {
        direct += received(2u, map_2, IS_CUBE_2, at);
    }
    if NUM_LIGHTS > 3u {
        direct += received(3u, map_3, IS_CUBE_3, at);
    }
    return surface_colour(in, is_front, direct * frame.pre_exposure);
}

// A visible point.
struct Receiver {
    point: vec3f,
    facet: vec3f,
    // Shading normal.
    normal: vec3f,
}

fn received(index: u32, map: texture_depth_2d_array, is_cube: bool, at: Receiver) -> vec3f {
    let light = lights[index];
    let arrival = arrival(light, at.point);
    let received = irradiance(light, arrival, at.normal);
    if !HAS_MAPS {
        return received;
    }
    return received * seen_share(light, arrival, shadow_maps[index], map, map_sampler, is_cube, at.point, at.facet);
}
