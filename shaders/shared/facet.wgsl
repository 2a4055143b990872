// How a visible point is turned.

// Unit normal of the triangle itself on the side that is seen; `middle` is the point under the middle of the pixel.
fn facet_normal(middle: vec3f) -> vec3f {
    let across = cross(dpdx(middle), dpdy(middle));
    let to_eye = frame.eye.xyz - frame.eye.w * middle;
    return normalize(select(-across, across, dot(across, to_eye) > 0.0));
}

// Unit shading normal on the side that is seen.
fn seen_normal(normal: vec3f, is_front: bool) -> vec3f {
    return normalize(select(-normal, normal, is_front));
}

// Some drivers' centroids lie off the plane of their triangle, and what lies behind its plane is in shadow.
fn on_facet(point: vec3f, middle: vec3f, facet: vec3f) -> vec3f {
    return point - dot(point - middle, facet) * facet;
}
