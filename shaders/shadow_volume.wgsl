// Shadow volume pass: counts in the stencil how many volumes each visible point is in.
//
// A corner is where it is, or infinitely far behind itself as the light sees it: (V w - L, 0). The reversed infinite
// projection puts w = 0 at depth 0 exactly, so nothing is ever clipped far away and both caps exist.

struct Corner {
    // Metres; w is 1 where the corner is to be infinitely far.
    @location(0) position: vec4f,
}

@vertex
fn vertex(in: Corner) -> @builtin(position) @invariant vec4f {
    if in.position.w > 0.0 {
        return frame.projection_from_world * vec4f(in.position.xyz * light.place.w - light.place.xyz, 0.0);
    }
    return frame.projection_from_world * vec4f(in.position.xyz, 1.0);
}

// Depth of a far plane that the projection itself does not have; 0 means none.
override FAR_DEPTH: f32 = 0.0;

// Takes away what such a far plane would: to show what that does to volumes.
@fragment
fn beyond(@builtin(position) position: vec4f) {
    if position.z < FAR_DEPTH {
        discard;
    }
}
