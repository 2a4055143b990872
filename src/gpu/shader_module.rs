//! A shader compiled for a device.

use super::Gpu;
use super::shader::Shader;

impl Shader {
    /// Compiles the current text of the shader, and registers the shader as in use on the device.
    #[must_use]
    pub fn module(&self, gpu: &Gpu) -> wgpu::ShaderModule {
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(gpu.shaders.text_of(*self).into()),
        })
    }
}
