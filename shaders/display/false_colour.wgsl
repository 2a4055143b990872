// Maps an illuminance to a colour, with lines of equal illuminance.

const LINE_WIDTH_PX: f32 = 1.3;

// Returns the position of an illuminance on the scale: 0..1 between its ends.
fn place_on_scale(lux: f32) -> f32 {
    let low = frame.lux_scale.x;
    let high = frame.lux_scale.y;
    let logarithmic = log2(max(lux, 1e-6) / low) / log2(high / low);
    return select((lux - low) / (high - low), logarithmic, frame.lux_scale.z > 0.0);
}

// Returns the linear display colour of an illuminance.
fn false_colour(lux: f32) -> vec3f {
    let place = place_on_scale(lux);
    let colour = linear_from_srgb(turbo(saturate(place)));
    // A line is at the upper end of each of the equal parts of the scale, none at its low end.
    let part = place * frame.lux_scale.w;
    let to_line = abs(fract(part - 0.5) - 0.5) / max(fwidth(part), 1e-6);
    let has_lines = frame.lux_scale.w > 0.0 && part > 0.5 && part < frame.lux_scale.w + 0.5;
    let line = select(0.0, saturate(LINE_WIDTH_PX - to_line), has_lines);
    return mix(colour, vec3f(0.0), line);
}

// Returns the Turbo colour map as a polynomial, sRGB (Mikhailov 2019, "Turbo, An Improved Rainbow Colormap for
// Visualization").
fn turbo(x: f32) -> vec3f {
    let powers = vec4f(1.0, x, x * x, x * x * x);
    let high_powers = powers.zw * powers.z;
    return saturate(vec3f(
        dot(powers, vec4f(0.13572138, 4.61539260, -42.66032258, 132.13108234))
            + dot(high_powers, vec2f(-152.94239396, 59.28637943)),
        dot(powers, vec4f(0.09140261, 2.19418839, 4.84296658, -14.18503333))
            + dot(high_powers, vec2f(4.27729857, 2.82956604)),
        dot(powers, vec4f(0.10667330, 12.64194608, -60.58204836, 110.36276771))
            + dot(high_powers, vec2f(-89.90310912, 27.34824973)),
    ));
}
