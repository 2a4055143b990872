// Direct light pass: adds the irradiance of one light sample at each visible point that is not in its shadow.
//
// The stencil test has already discarded points in shadow volumes and under planar shadows. `visibility` returns the
// fraction of the light that a shadow map lets through.

@fragment
fn fragment(in: LitPoint, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let facet = facet_of(in.middle);
    let position = from_light(light, light.kind, on_facet(in.point, in.middle, facet));
    let at = Receiver(position, facet, seen_normal(in.normal, is_front));
    let arrival = arrival(light.kind, position);
    let received = irradiance(light, light.kind, arrival, at.normal);
    if all(received <= vec3f(0.0)) {
        discard;
    }
    let visible = visibility(arrival, at);
    if visible <= 0.0 {
        discard;
    }
    // The fourth channel counts the visible light samples.
    return vec4f(received * visible, visible);
}
