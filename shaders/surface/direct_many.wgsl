// Surface pass: direct irradiance of each sample from a texture with several samples a pixel.

@group(3) @binding(0) var direct_irradiance: texture_multisampled_2d<f32>;

@fragment
fn fragment(
    in: Varying,
    @builtin(front_facing) is_front: bool,
    @builtin(sample_index) sample: u32
) -> Shown {
    return surface_colour(in, is_front, textureLoad(direct_irradiance, vec2i(in.position.xy), i32(sample)).rgb);
}
