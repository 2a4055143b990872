// Linear Rec. 709 colour and its sRGB encoding (IEC 61966-2-1), as in src/base/colour.rs.

fn luminance(colour: vec3f) -> f32 {
    return dot(colour, vec3f(0.2126, 0.7152, 0.0722));
}

// Encodes a linear colour. The power of 1 / 2.4 is a polynomial of the fourth root with an error below 7e-6, because a
// software driver takes long for a power and every pixel needs one.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let t = sqrt(sqrt(max(linear, vec3f(0.0))));
    let high = ((((-0.0681477 * t + 0.2895344) * t - 0.5774844) * t + 1.2554054) * t + 0.162026) * t - 0.0613402;
    return select(high, low, linear <= vec3f(0.0031308));
}

fn linear_from_srgb(encoded: vec3f) -> vec3f {
    let low = encoded / 12.92;
    let high = pow((max(encoded, vec3f(0.0)) + 0.055) / 1.055, vec3f(2.4));
    return select(high, low, encoded <= vec3f(0.04045));
}
