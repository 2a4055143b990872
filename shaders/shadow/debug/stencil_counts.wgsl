// Debug view: draws the counts of the stencil as colours over the picture.

// True if the format of the target encodes sRGB itself.
override TARGET_ENCODES: bool = false;
// Bits of the stencil that are counts.
override COUNT_BITS: u32 = 255u;
// Largest count with a colour of its own; higher counts have the same colour.
const MOST: f32 = 8.0;
// Colour of the count 0. It is translucent and only dims the picture.
const NONE: vec4f = vec4f(0.04, 0.045, 0.06, 0.6);
// Colour of a negative count, which is a fault: more volumes were left than entered.
const NEGATIVE: vec3f = vec3f(1.0, 0.2, 0.9);
const OPACITY: f32 = 0.78;

@group(1) @binding(0) var counts: texture_2d<u32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let count = i32(textureLoad(counts, vec2i(position.xy), 0).r & COUNT_BITS);
    if count == 0 {
        return NONE;
    }
    // The stencil wraps at 256: the upper half is negative.
    let colour = select(turbo(min(f32(count) / MOST, 1.0)), NEGATIVE, count > 127);
    return vec4f(select(colour, linear_from_srgb(colour), TARGET_ENCODES), OPACITY);
}
