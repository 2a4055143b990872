// Direct light pass: adds the irradiance of one light sample at every visible point that is not in its shadow.
//
// The stencil test has thrown away what shadow volumes and planar shadows darken; `visibility` tells the rest.

@fragment
fn fragment(in: VisiblePoint, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let facet = facet_normal(in.middle);
    let received = irradiance(in.point, seen_normal(in, is_front));
    if all(received <= vec3f(0.0)) {
        discard;
    }
    // Some drivers' centroids lie off the plane of their triangle, and what lies behind its plane is in shadow.
    let off_plane = dot(in.point - in.middle, facet) * facet;
    let visible = visibility(in.point - off_plane, facet);
    if visible <= 0.0 {
        discard;
    }
    // The fourth channel counts the light samples that are seen.
    return vec4f(received * (visible * frame.pre_exposure), visible);
}

// Unit normal of the triangle itself on the side that is seen.
fn facet_normal(middle: vec3f) -> vec3f {
    let across = cross(dpdx(middle), dpdy(middle));
    let to_eye = frame.eye.xyz - frame.eye.w * middle;
    return normalize(select(-across, across, dot(across, to_eye) > 0.0));
}
