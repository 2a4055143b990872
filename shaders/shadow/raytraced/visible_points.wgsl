// Visible points pass: stores position and normal of the surface in each pixel, for rays on the CPU.

struct Output {
    // Position, metres; w is 1 if there is a surface.
    @location(0) point: vec4f,
    @location(1) normal: vec4f,
}

@fragment
fn fragment(in: VisiblePoint, @builtin(front_facing) is_front: bool) -> Output {
    return Output(vec4f(in.point, 1.0), vec4f(seen_normal(in.normal, is_front), 0.0));
}
