// The light sample of a pass that draws one sample. No branch depends on it, for the reason in shared/frame.wgsl.

@group(1) @binding(0) var<uniform> light: LightSample;
