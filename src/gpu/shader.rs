//! Shader modules: WGSL files laid end to end, compiled for the device, checked by naga.
//!
//! Each pass declares its own [`Shader`] with the [`shader!`] macro. There is no preprocessor: a shader is a list of files
//! below `shaders/`, and variants of it are pipeline `override` constants. `tests/shaders.rs` finds every declaration in the
//! sources and validates it.

use super::Gpu;

/// A complete WGSL module and the files it is made of.
pub struct Shader {
    /// Stem of its main file, the label of its module.
    pub name: &'static str,
    /// (file name below `shaders/`, text built in), laid end to end.
    pub parts: &'static [(&'static str, &'static str)],
}

/// Declares a [`Shader`]: its name and its files below `shaders/`, in order.
macro_rules! shader {
    ($name:literal, $($file:literal),+ $(,)?) => {
        $crate::gpu::shader::Shader {
            name: $name,
            parts: &[$(($file, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $file)))),+],
        }
    };
}
pub(crate) use shader;

impl Shader {
    /// The WGSL text.
    #[must_use]
    pub fn source(&self) -> String {
        self.parts.iter().map(|(_, text)| *text).collect::<Vec<_>>().join("\n")
    }

    /// Compiles the built-in text.
    #[must_use]
    pub fn module(&self, gpu: &Gpu) -> wgpu::ShaderModule {
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.source().into()),
        })
    }
}

/// Parses and validates WGSL; the error is naga's own message with the place marked.
///
/// # Errors
/// The text is no valid module.
pub fn validate(source: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    Ok(())
}

/// Byte offsets of the members of a WGSL struct and its size, to hold Rust structs against.
#[cfg(test)]
pub fn struct_layout(shader: &Shader, name: &str) -> Vec<usize> {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).expect("the struct is there");
    let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is no struct") };
    members.iter().map(|member| member.offset).chain([*span]).map(|offset| offset as usize).collect()
}

/// A whole number of a WGSL module, to hold Rust constants against.
#[cfg(test)]
pub fn constant(shader: &Shader, name: &str) -> u32 {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) =
        module.constants.iter().find(|(_, known)| known.name.as_deref() == Some(name)).expect("it is there");
    match module.global_expressions[found.init] {
        naga::Expression::Literal(naga::Literal::U32(value)) => value,
        _ => panic!("{name} is no whole number"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_shader_is_refused_with_its_place() {
        let message = validate("@fragment fn main() -> u32 { return 1.5; }").unwrap_err();
        assert!(message.contains("1:"), "{message}");
    }
}
