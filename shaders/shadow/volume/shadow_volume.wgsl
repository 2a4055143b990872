// Shadow volume pass: draws the volumes that the stencil counts.
//
// A corner v is drawn at its own position, or moved away from the light (L, w) to infinity: (v w - L, 0). The reversed
// infinite projection maps w = 0 to depth 0 exactly. So no far plane clips anything, and the far caps of z-fail are at
// infinity (Everitt and Kilgard 2002).

const INFINITELY_FAR: f32 = 1.0;
const SHORTEST: f32 = 1e-30;

struct Corner {
    // Position, metres; w is INFINITELY_FAR for a corner at infinity, else 0.
    @location(0) position: vec4f,
}

@vertex
fn vertex(in: Corner) -> @builtin(position) @invariant vec4f {
    if in.position.w == INFINITELY_FAR {
        let away = in.position.xyz * light.position.w - light.position.xyz;
        // The direction is normalised, because clipping between corners of very different lengths is inexact.
        return frame.projection_from_world * vec4f(away / max(length(away), SHORTEST), 0.0);
    }
    return frame.projection_from_world * vec4f(in.position.xyz, 1.0);
}

// Depth of an artificial far plane; 0 disables it.
override FAR_DEPTH: f32 = 0.0;

// Discards the volume beyond the artificial far plane, to show the effect of such a plane.
@fragment
fn beyond(@builtin(position) position: vec4f) {
    if position.z < FAR_DEPTH {
        discard;
    }
}
