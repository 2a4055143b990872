// The light of each vertex, summed over the light groups with their weights.
//
// The sum is computed again when a lamp is dimmed or new light is written. It does not depend on the camera.

// Irradiance of the vertices: [2 x group + (0 direct, 1 indirect)][vertex], three floats each.
@group(1) @binding(0) var<storage, read> irradiance: array<f32>;
// Summed irradiance of the vertices: [vertex], direct then indirect, three floats each.
@group(1) @binding(1) var<storage, read_write> weighted: array<f32>;

@compute @workgroup_size(64)
fn weigh(@builtin(global_invocation_id) invocation: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let vertex = invocation.x + 64u * groups.x * invocation.y;
    if vertex >= frame.num_vertices {
        return;
    }
    var direct = vec3f(0.0);
    var indirect = vec3f(0.0);
    for (var group = 0u; group < choices.num_groups; group++) {
        let weight = group_weight(group);
        direct += weight * stored_irradiance(2u * group, vertex);
        indirect += weight * stored_irradiance(2u * group + 1u, vertex);
    }
    for (var channel = 0u; channel < 3u; channel++) {
        weighted[6u * vertex + channel] = direct[channel];
        weighted[6u * vertex + 3u + channel] = indirect[channel];
    }
}

fn stored_irradiance(part: u32, vertex: u32) -> vec3f {
    let at = 3u * (part * frame.num_vertices + vertex);
    return vec3f(irradiance[at], irradiance[at + 1u], irradiance[at + 2u]);
}
