// Tone mapping: radiance becomes a display colour, sample by sample, so that edges of bright lamps stay smooth.

// The target's format encodes sRGB itself.
override TARGET_ENCODES: bool = false;

@group(1) @binding(1) var<storage, read> metered_exposure: f32;

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let encoded = srgb_from_linear(saturate(pixel_colour(pixel)));
    // Half a step of noise hides the steps of eight bits; a colour that is a step itself stays as it is.
    let dithered = saturate(encoded + gradient_noise(position.xy) / 255.0);
    return vec4f(select(dithered, linear_from_srgb(dithered), TARGET_ENCODES), 1.0);
}

// Mean display colour of the samples; inside a surface they are alike and one is enough.
fn pixel_colour(pixel: vec2i) -> vec3f {
    let first = hdr_sample(pixel, 0u);
    var are_alike = true;
    for (var i = 1u; i < num_samples(); i++) {
        are_alike &= all(hdr_sample(pixel, i) == first);
    }
    if are_alike {
        return display_colour(first);
    }
    var sum = vec3f(0.0);
    for (var i = 0u; i < num_samples(); i++) {
        sum += display_colour(hdr_sample(pixel, i));
    }
    return sum / f32(num_samples());
}

fn display_colour(hdr_premultiplied: vec4f) -> vec3f {
    let exposure = select(metered_exposure, frame.exposure, frame.exposure > 0.0);
    let exposed = hdr_premultiplied.rgb * (exposure / frame.pre_exposure);
    return tone_mapped(exposed) + (1.0 - hdr_premultiplied.a) * frame.background;
}

fn tone_mapped(colour: vec3f) -> vec3f {
    if choices.tone_map == TONE_MAP_LINEAR {
        return saturate(colour);
    }
    return neutral(colour);
}

// Khronos PBR Neutral tone mapper (Khronos 2024), without the offset that takes away 4 % of mirror reflection: these
// surfaces are diffuse and reflect none.
fn neutral(colour: vec3f) -> vec3f {
    const START: f32 = 0.8;
    const DESATURATION: f32 = 0.15;
    let peak = max(colour.r, max(colour.g, colour.b));
    if peak < START {
        return colour;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let whitening = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    return mix(colour * (new_peak / peak), vec3f(new_peak), whitening);
}

// Interleaved gradient noise in -0.49..0.49: a hair less than half, so that rounding brings a whole step back
// (Jimenez 2014, "Next Generation Post Processing in Call of Duty").
fn gradient_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715)))) * 0.98 - 0.49;
}
