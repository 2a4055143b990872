// Direct light pass: adds the irradiance of one light sample at every visible point that is not in its shadow.
//
// The stencil test has thrown away what shadow volumes and planar shadows darken; `visibility` tells the rest.

@fragment
fn fragment(in: LitPoint, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let facet = facet_of(in.middle);
    let place = from_light(light, light.kind, on_facet(in.point, in.middle, facet));
    let at = Receiver(place, facet, seen_normal(in.normal, is_front));
    let arrival = arrival(light.kind, place);
    let received = irradiance(light, light.kind, arrival, at.normal);
    if all(received <= vec3f(0.0)) {
        discard;
    }
    let visible = visibility(arrival, at);
    if visible <= 0.0 {
        discard;
    }
    // The fourth channel counts the light samples that are seen.
    return vec4f(received * visible, visible);
}
