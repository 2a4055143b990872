// Normals of a visible point, in world or light space.

// Returns a vector along the normal of the triangle on its visible side; `middle` is the point at the centre of the
// pixel. Derivatives point down and to the right on the screen, so their cross product points to the eye.
fn facet_of(middle: vec3f) -> vec3f {
    return cross(dpdy(middle), dpdx(middle));
}

// Returns the unit shading normal on the visible side.
fn seen_normal(normal: vec3f, is_front: bool) -> vec3f {
    return normalize(select(-normal, normal, is_front));
}

// Projects a point back on to the plane of its triangle. Some drivers return centroids slightly off the plane, and a
// point behind the plane would be in shadow.
fn on_facet(point: vec3f, middle: vec3f, facet: vec3f) -> vec3f {
    return point - dot(point - middle, facet) / dot(facet, facet) * facet;
}
