// Planar shadow pass: marks receivers, and on them the casters flattened by Blinn's matrix.

struct Corner {
    // Homogeneous, world space; flattened casters may have any w.
    @location(0) position: vec4f,
}

@vertex
fn vertex(in: Corner) -> @builtin(position) @invariant vec4f {
    return frame.projection_from_world * in.position;
}
