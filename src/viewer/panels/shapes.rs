//! The panels as triangles, and the render pass that draws them.

/// Background colour of the window.
pub(in crate::viewer) const EMPTY: wgpu::Color = wgpu::Color { r: 0.05, g: 0.055, b: 0.065, a: 1.0 };

/// The panels of a frame as triangles.
pub struct PanelShapes {
    /// Triangles, clipped to rectangles.
    pub primitives: Vec<egui::ClippedPrimitive>,
    /// Changes of textures: new ones, and those that are no longer used.
    pub textures: egui::TexturesDelta,
    /// Pixels per point.
    pub pixels_per_point: f32,
    /// Area of the side panel, points; empty if it is hidden.
    pub side: egui::Rect,
    /// Position of the divider of a split picture, as a share of its width.
    pub divider: f32,
}

/// Begins a render pass of panels.
pub(in crate::viewer) fn begin_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("panels"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}
