//! The stencil of direct light: the meaning of its bits, and states that several techniques use.
//!
//! A light sample starts with a cleared stencil. Techniques mark what is in shadow, and the direct light pass then adds
//! light where the bits that it reads are zero. Shadow volumes count in all eight bits. Planar shadows split them:
//!
//! ```text
//! bit   7 6 5 4 3   2 1 0
//!       receiver    shadows on it
//! ```

/// Bits that count planar shadows over a point. The cut-out pass sets the lowest of them.
pub const SHADOW_BITS: u32 = 0x07;
/// Bits that hold the number of the planar receiver that a point lies on, from 1; 0 means no receiver.
pub const RECEIVER_BITS: u32 = 0xf8;
/// Stencil value of receiver number 1.
pub const FIRST_RECEIVER: u32 = 0x08;
/// Largest number of receivers that [`RECEIVER_BITS`] can distinguish.
pub const MAX_RECEIVERS: usize = 31;

/// Returns a stencil state that is the same for both faces of a triangle.
pub fn both_faces(face: wgpu::StencilFaceState, read_mask: u32, write_mask: u32) -> wgpu::StencilState {
    wgpu::StencilState { front: face, back: face, read_mask, write_mask }
}

/// Returns an operation that applies `pass_op` where the stencil test `compare` and the depth test pass, and leaves the
/// stencil unchanged elsewhere.
pub fn on_pass(compare: wgpu::CompareFunction, pass_op: wgpu::StencilOperation) -> wgpu::StencilFaceState {
    let keep = wgpu::StencilOperation::Keep;
    wgpu::StencilFaceState { compare, fail_op: keep, depth_fail_op: keep, pass_op }
}
