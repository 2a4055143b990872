// Tone mapping pass: maps radiance to display colours. Each sample is mapped separately, so the edges of bright lamps
// stay smooth.

@group(1) @binding(1) var<storage, read> metered_exposure: f32;

// Values that are constant over the picture pass from vertices to pixels, for the reasons in shared/frame.wgsl.
struct Varying {
    @builtin(position) position: vec4f,
    // Factor from the HDR picture to exposed light.
    @location(0) @interpolate(flat) exposure: f32,
    @location(1) @interpolate(flat) background: vec3f,
    @location(2) @interpolate(flat) tone_map: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    // One triangle that covers the target.
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    let exposure = select(metered_exposure, frame.exposure, frame.exposure > 0.0);
    let position = vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
    return Varying(position, exposure / frame.pre_exposure, frame.background, choices.tone_map);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4f {
    return displayed(pixel_colour(in), in.position.xy);
}

// Returns the mean display colour of the samples. Inside a surface all samples are equal, and one is enough.
fn pixel_colour(in: Varying) -> vec3f {
    let pixel = vec2i(in.position.xy);
    let first = hdr_sample(pixel, 0u);
    var are_alike = true;
    for (var i = 1u; i < num_samples(); i++) {
        are_alike &= all(hdr_sample(pixel, i) == first);
    }
    if are_alike {
        return display_colour(first, in);
    }
    var sum = vec3f(0.0);
    for (var i = 0u; i < num_samples(); i++) {
        sum += display_colour(hdr_sample(pixel, i), in);
    }
    return sum / f32(num_samples());
}

fn display_colour(hdr_premultiplied: vec4f, in: Varying) -> vec3f {
    return tone_mapped(hdr_premultiplied.rgb * in.exposure, in.tone_map) + (1.0 - hdr_premultiplied.a) * in.background;
}
