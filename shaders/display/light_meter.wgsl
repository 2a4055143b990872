// Light meter: computes the exposure of a picture from a histogram of its log2 luminance.
//
// The log-average is placed at middle grey (Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images",
// eq. 1), unless the brightest twentieth of the pixels would then exceed HIGHLIGHT times white.

const NUM_BINS: u32 = 256u;
// Distance between counted pixels in rows and columns: 2 for a picture on its own, 4 in a movement.
override STEP: u32 = 2u;
// The bins cover luminances from 2^-20 to 2^20. Bin 0 also holds darker pixels and is ignored.
const DARKEST: f32 = -20.0;
const BINS_PER_STOP: f32 = 6.4;
// Display luminance that the log-average is mapped to.
const MIDDLE_GREY: f32 = 0.2;
// Share of pixels, from the dark end, that must not exceed HIGHLIGHT x white.
const HIGHLIGHT_SHARE: f32 = 0.95;
const HIGHLIGHT: f32 = 1.5;

// True if the picture holds luminance, which is 0 for pixels without a surface. False if it holds radiance and
// coverage.
override IS_LUMINANCE: bool = false;

@group(1) @binding(0) var hdr: texture_2d<f32>;
@group(1) @binding(1) var<storage, read_write> histogram: array<atomic<u32>, NUM_BINS>;
@group(1) @binding(2) var<storage, read_write> metered_exposure: f32;

var<workgroup> tile: array<atomic<u32>, NUM_BINS>;

// Each group counts 16 x 16 pixels and adds them to the histogram. Integer sums do not depend on the order.
@compute @workgroup_size(16, 16)
fn count(@builtin(global_invocation_id) invocation: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = STEP * invocation.xy;
    if all(pixel < textureDimensions(hdr)) {
        let texel = textureLoad(hdr, pixel, 0);
        if texel.a > 0.5 {
            let seen = select(luminance(texel.rgb) / texel.a, texel.r, IS_LUMINANCE);
            atomicAdd(&tile[bin_of(seen / frame.pre_exposure)], 1u);
        }
    }
    workgroupBarrier();
    atomicAdd(&histogram[local], atomicLoad(&tile[local]));
}

fn bin_of(value: f32) -> u32 {
    let bin = (log2(max(value, 1e-30)) - DARKEST) * BINS_PER_STOP;
    return u32(clamp(bin, 0.0, f32(NUM_BINS) - 1.0));
}

fn log2_of_bin(bin: u32) -> f32 {
    return (f32(bin) + 0.5) / BINS_PER_STOP + DARKEST;
}

@compute @workgroup_size(1)
fn settle() {
    var total = 0.0;
    var log_sum = 0.0;
    for (var bin = 1u; bin < NUM_BINS; bin++) {
        let pixels = f32(atomicLoad(&histogram[bin]));
        total += pixels;
        log_sum += pixels * log2_of_bin(bin);
    }
    if total == 0.0 {
        metered_exposure = 1.0;
        return;
    }
    let for_average = MIDDLE_GREY / exp2(log_sum / total);
    let for_highlights = HIGHLIGHT / exp2(log2_of_bin(bin_at_share(HIGHLIGHT_SHARE * total)));
    metered_exposure = min(for_average, for_highlights);
}

fn bin_at_share(pixels_below: f32) -> u32 {
    var below = 0.0;
    for (var bin = 1u; bin < NUM_BINS; bin++) {
        below += f32(atomicLoad(&histogram[bin]));
        if below >= pixels_below {
            return bin;
        }
    }
    return NUM_BINS - 1u;
}
