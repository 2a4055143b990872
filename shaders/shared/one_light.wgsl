// The light sample of a pass that visits one after the other. No branch depends on it, as shared/frame.wgsl explains.

@group(1) @binding(0) var<uniform> light: LightSample;
