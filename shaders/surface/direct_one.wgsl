// Surface pass: direct irradiance of each pixel from a texture.

@group(3) @binding(0) var direct_irradiance: texture_2d<f32>;

@fragment
fn fragment(in: Varying, @builtin(front_facing) is_front: bool) -> Shown {
    return surface_colour(in, is_front, textureLoad(direct_irradiance, vec2i(in.position.xy), 0).rgb);
}
