// How a visible point is turned, in world or light space.

// Along the normal of the triangle itself on the side that is seen; `middle` is the point under the middle of the pixel. The
// cross product of the ways down and to the right points to the eye.
fn facet_of(middle: vec3f) -> vec3f {
    return cross(dpdy(middle), dpdx(middle));
}

// Unit shading normal on the side that is seen.
fn seen_normal(normal: vec3f, is_front: bool) -> vec3f {
    return normalize(select(-normal, normal, is_front));
}

// Some drivers' centroids lie off the plane of their triangle, and what lies behind its plane is in shadow.
fn on_facet(point: vec3f, middle: vec3f, facet: vec3f) -> vec3f {
    return point - dot(point - middle, facet) / dot(facet, facet) * facet;
}
