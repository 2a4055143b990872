// Planar shadow pass: draws receivers, and casters projected on to them by Blinn's matrix.

struct Corner {
    // Homogeneous position in world space; projected casters may have any w.
    @location(0) position: vec4f,
}

@vertex
fn vertex(in: Corner) -> @builtin(position) @invariant vec4f {
    return frame.projection_from_world * in.position;
}
