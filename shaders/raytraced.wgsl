// Where the visible points are and how they are turned, for rays on the CPU.

struct Found {
    // Metres; w is 1 where there is a surface.
    @location(0) point: vec4f,
    @location(1) normal: vec4f,
}

@fragment
fn fragment(in: VisiblePoint, @builtin(front_facing) is_front: bool) -> Found {
    return Found(vec4f(in.point, 1.0), vec4f(seen_normal(in.normal, is_front), 0.0));
}
