//! The supported extensions, those that can be ignored, and the check of the extensions that a file requires.

use gltf::json::Root;

use crate::scene::gltf::error::Cause;

/// Extensions that are supported in full.
const SUPPORTED: [&str; 17] = [
    "EXT_lights_ies",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];

/// Extensions that change neither geometry nor diffuse light. A file that requires them is read without them.
const HARMLESS: [&str; 10] = [
    "KHR_animation_pointer",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_volume",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Checks the required extensions, and returns a note about extensions that are ignored.
///
/// # Errors
/// Returns an error if the file requires an extension that is neither supported nor harmless.
pub(crate) fn check(root: &Root) -> Result<Option<String>, Cause> {
    for name in &root.extensions_required {
        if !SUPPORTED.contains(&name.as_str()) && !HARMLESS.contains(&name.as_str()) {
            return Err(Cause::RequiredExtension { name: name.escape_debug().to_string(), hint: hint(name) });
        }
    }
    let mut ignored: Vec<_> = root.extensions_used.iter().filter(|name| !SUPPORTED.contains(&name.as_str())).collect();
    ignored.sort_unstable();
    ignored.dedup();
    let names: Vec<_> = ignored.iter().map(|name| name.escape_debug().to_string()).collect();
    Ok((!names.is_empty()).then(|| format!("these extensions are ignored: {}", names.join(", "))))
}

/// Returns advice on how to convert a file that requires an extension into one that does not.
pub(crate) fn hint(name: &str) -> &'static str {
    match name {
        "EXT_texture_avif" => "convert its textures with: gltf-transform png IN.glb OUT.glb --formats \"*\"",
        "MSFT_texture_dds" => "export its textures as PNG or JPEG",
        _ => "export the file without it",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(required: &str, used: &str) -> Root {
        Root {
            extensions_required: vec![required.to_owned()],
            extensions_used: vec![used.to_owned()],
            ..Root::default()
        }
    }

    #[test]
    fn a_required_unsupported_extension_is_refused_with_advice() {
        let error = check(&root("EXT_texture_avif", "")).expect_err("we cannot decode it").to_string();
        assert!(error.contains("EXT_texture_avif") && error.contains("gltf-transform png"), "{error}");
    }

    #[test]
    fn an_optional_unsupported_extension_is_noted() {
        let note = check(&root("KHR_mesh_quantization", "ACME_fog")).expect("loads").expect("a note");
        assert!(note.contains("ACME_fog"));
    }
}
