//! Declaration of shaders: WGSL files concatenated to one module.
//!
//! Each pass declares its own [`Shader`] with the `shader!` macro. There is no preprocessor: a shader is a list of
//! files below `shaders/`, and its variants are pipeline `override` constants. `tests/shaders.rs` finds every
//! declaration in the sources and validates it with naga; `shader_library` reloads the files while the program runs.

/// A complete WGSL module with the files of which it consists.
#[derive(Clone, Copy)]
pub struct Shader {
    /// Label of the module.
    pub name: &'static str,
    /// Pairs of file name below `shaders/` and text built into the program, in order.
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
    /// Returns the built-in text.
    #[must_use]
    pub fn source(&self) -> String {
        self.parts.iter().map(|(_, text)| *text).collect::<Vec<_>>().join("\n")
    }

    /// Returns true if both shaders consist of the same files.
    pub(super) fn is(&self, other: &Self) -> bool {
        self.parts.iter().map(|(file, _)| file).eq(other.parts.iter().map(|(file, _)| file))
    }
}

/// Byte offsets of the members of a WGSL struct and its size, for tests that compare Rust structs with them.
#[cfg(test)]
pub fn struct_layout(shader: &Shader, name: &str) -> Vec<usize> {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).expect("the struct exists");
    let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is no struct") };
    members.iter().map(|member| member.offset).chain([*span]).map(|offset| offset as usize).collect()
}

/// Returns an integer constant of a WGSL module, for tests that compare Rust constants with it.
#[cfg(test)]
pub fn constant(shader: &Shader, name: &str) -> u32 {
    let module = naga::front::wgsl::parse_str(&shader.source()).expect("every shader is valid");
    let (_, found) =
        module.constants.iter().find(|(_, known)| known.name.as_deref() == Some(name)).expect("the constant exists");
    match module.global_expressions[found.init] {
        naga::Expression::Literal(naga::Literal::U32(value)) => value,
        _ => panic!("{name} is no whole number"),
    }
}
