//! The side panel as it was painted last.
//!
//! On a software driver the hundreds of glyphs of the panel take longer than the picture. They do not change during a
//! walk, so the cached painting is copied.

use egui::epaint::Primitive;
use egui::{ClippedPrimitive, Rect};
use egui_wgpu::ScreenDescriptor;

use crate::gpu::Gpu;
use crate::viewer::panels::shapes::{EMPTY, PanelShapes, begin_pass};
use crate::viewer::picture::texture::{new_texture, view_of};

/// The side panel as it was painted last.
#[derive(Default)]
pub struct KeptSide {
    painted: Option<Painted>,
}

struct Painted {
    /// Texture of the size of the window.
    texture: wgpu::Texture,
    shapes: Vec<ClippedPrimitive>,
    pixels_per_point: f32,
}

impl KeptSide {
    /// Paints all panels over `target`. The side panel is copied from the last painting if none of its shapes has
    /// changed.
    /// `egui_wgpu::Renderer::update_buffers` must have been called for the panels.
    pub fn paint(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        painter: &egui_wgpu::Renderer,
        target: &wgpu::Texture,
        panels: &mut PanelShapes,
    ) {
        let size = [target.width(), target.height()];
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: panels.pixels_per_point };
        let side = panels.side;
        let is_inside = |clip: &Rect| side.expand(0.5).contains_rect(*clip);
        if side.is_positive() {
            if !self.shows(size, panels, is_inside) {
                let last = self.painted.take().map(|painted| painted.texture);
                let texture = last.filter(|last| [last.width(), last.height()] == size);
                let texture = texture.unwrap_or_else(|| new_texture(gpu, size, target.format()));
                let pass = begin_pass(encoder, &view_of(&texture), wgpu::LoadOp::Clear(EMPTY));
                paint(painter, pass, &mut panels.primitives, &screen, is_inside);
                let shapes = panels.primitives.iter().filter(|shape| is_inside(&shape.clip_rect)).cloned().collect();
                self.painted = Some(Painted { texture, shapes, pixels_per_point: panels.pixels_per_point });
            }
            if let Some(Painted { texture, .. }) = &self.painted {
                copy(encoder, texture, target, side * panels.pixels_per_point);
            }
        }
        let pass = begin_pass(encoder, &view_of(target), wgpu::LoadOp::Load);
        paint(painter, pass, &mut panels.primitives, &screen, |clip| !is_inside(clip));
    }

    /// Returns true if the last painting shows these panels.
    fn shows(&self, size: [u32; 2], panels: &PanelShapes, is_inside: impl Fn(&Rect) -> bool) -> bool {
        let Some(Painted { texture, shapes, pixels_per_point }) = &self.painted else { return false };
        let inside = panels.primitives.iter().filter(|shape| is_inside(&shape.clip_rect));
        [texture.width(), texture.height()] == size
            && *pixels_per_point == panels.pixels_per_point
            && panels.textures.set.is_empty()
            && inside.clone().count() == shapes.len()
            && inside.zip(shapes).all(|(new, last)| is_same(new, last))
    }
}

fn is_same(a: &ClippedPrimitive, b: &ClippedPrimitive) -> bool {
    match (&a.primitive, &b.primitive) {
        (Primitive::Mesh(mesh), Primitive::Mesh(other)) => a.clip_rect == b.clip_rect && mesh == other,
        _ => false,
    }
}

/// Paints the shapes for whose clip rectangle `is_wanted` returns true. The others are clipped to nothing, and egui
/// skips them.
fn paint(
    painter: &egui_wgpu::Renderer,
    pass: wgpu::RenderPass<'_>,
    shapes: &mut [ClippedPrimitive],
    screen: &ScreenDescriptor,
    is_wanted: impl Fn(&Rect) -> bool,
) {
    let clips: Vec<Rect> = shapes.iter().map(|shape| shape.clip_rect).collect();
    for shape in shapes.iter_mut().filter(|shape| !is_wanted(&shape.clip_rect)) {
        shape.clip_rect = Rect::ZERO;
    }
    painter.render(&mut pass.forget_lifetime(), shapes, screen);
    for (shape, clip) in shapes.iter_mut().zip(clips) {
        shape.clip_rect = clip;
    }
}

/// Copies the rectangle `area`, in pixels.
fn copy(encoder: &mut wgpu::CommandEncoder, source: &wgpu::Texture, target: &wgpu::Texture, area: Rect) {
    let limits = [target.width(), target.height()];
    let [left, right] = [area.left(), area.right()].map(|x| (x.round().max(0.0) as u32).min(limits[0]));
    let [top, bottom] = [area.top(), area.bottom()].map(|y| (y.round().max(0.0) as u32).min(limits[1]));
    let origin = wgpu::Origin3d { x: left, y: top, z: 0 };
    let at = |texture| wgpu::TexelCopyTextureInfo { origin, ..wgpu::Texture::as_image_copy(texture) };
    let size = wgpu::Extent3d {
        width: right.saturating_sub(left),
        height: bottom.saturating_sub(top),
        depth_or_array_layers: 1,
    };
    encoder.copy_texture_to_texture(at(source), at(target), size);
}
