// Vertex stage of passes over the visible surfaces.

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

struct VisiblePoint {
    @builtin(position) @invariant position: vec4f,
    // Position in world space, metres. It is interpolated at the centroid, so that the point lies on its triangle.
    @location(0) @interpolate(perspective, centroid) point: vec3f,
    // Shading normal of the front, of any length.
    @location(1) @interpolate(perspective, centroid) normal: vec3f,
}

@vertex
fn vertex(in: Vertex) -> VisiblePoint {
    return VisiblePoint(frame.projection_from_world * vec4f(in.position, 1.0), in.position, in.normal);
}
