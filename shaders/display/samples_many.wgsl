// The HDR picture with several samples a pixel.

@group(1) @binding(0) var hdr: texture_multisampled_2d<f32>;

fn num_samples() -> u32 {
    return textureNumSamples(hdr);
}

fn hdr_sample(pixel: vec2i, index: u32) -> vec4f {
    return textureLoad(hdr, pixel, i32(index));
}
