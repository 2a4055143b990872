// Visibility by the stencil: points that pass the stencil test are fully lit.

fn visibility(arrival: Arrival, at: Receiver) -> f32 {
    return 1.0;
}
