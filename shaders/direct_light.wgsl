// Direct light pass: adds the irradiance of one light sample at every visible point that is not in its shadow.
//
// The stencil test has thrown away what shadow volumes and planar shadows darken; `visibility` tells the rest.

@fragment
fn fragment(in: VisiblePoint, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let facet = facet_normal(in.middle);
    let arrival = arrival(light, in.point);
    let received = irradiance(light, arrival, seen_normal(in.normal, is_front));
    if all(received <= vec3f(0.0)) {
        discard;
    }
    let visible = visibility(on_facet(in.point, in.middle, facet), facet);
    if visible <= 0.0 {
        discard;
    }
    // The fourth channel counts the light samples that are seen.
    return vec4f(received * (visible * frame.pre_exposure), visible);
}
