// The HDR picture without multisampling.

@group(1) @binding(0) var hdr: texture_2d<f32>;

fn num_samples() -> u32 {
    return 1u;
}

fn hdr_sample(pixel: vec2i, index: u32) -> vec4f {
    return textureLoad(hdr, pixel, 0);
}
