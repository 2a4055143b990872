// Vertex stage of passes that light the visible surfaces, in light space.

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

struct LitPoint {
    @builtin(position) @invariant position: vec4f,
    // Position in light space, metres. It is interpolated at the centroid, so that the point lies on its triangle.
    @location(0) @interpolate(perspective, centroid) point: vec3f,
    // Shading normal of the front, of any length.
    @location(1) @interpolate(perspective, centroid) normal: vec3f,
    // The point at the centre of the pixel, on the plane of its triangle. Unlike a centroid it has derivatives.
    @location(2) middle: vec3f,
}

@vertex
fn vertex(in: Vertex) -> LitPoint {
    let point = position_in_light_space(light, in.position);
    let normal = in_light_space(light, in.normal);
    return LitPoint(frame.projection_from_world * vec4f(in.position, 1.0), point, normal, point);
}
