// Tone mapping: radiance becomes a display colour, sample by sample, so that edges of bright lamps stay smooth.

@group(1) @binding(1) var<storage, read> metered_exposure: f32;

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return displayed(pixel_colour(vec2i(position.xy)), position.xy);
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
    return tone_mapped(exposed, choices.tone_map) + (1.0 - hdr_premultiplied.a) * frame.background;
}
