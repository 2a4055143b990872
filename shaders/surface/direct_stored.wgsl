// Surface pass: all light comes from the vertices.

@fragment
fn fragment(in: Varying, @builtin(front_facing) is_front: bool) -> Shown {
    return surface_colour(in, is_front, vec3f(0.0));
}
