//! KHR_materials_variants: alternative sets of materials.
//!
//! Source: the extension's specification.

use gltf::json::Root;
use gltf::json::mesh::Primitive;
use serde::Deserialize;

use crate::scene::gltf::error::Cause;

/// Name of the extension.
pub(crate) const EXTENSION: &str = "KHR_materials_variants";

#[derive(Deserialize)]
struct Variants {
    variants: Vec<Variant>,
}

#[derive(Deserialize)]
struct Variant {
    name: String,
}

#[derive(Deserialize)]
struct Mappings {
    mappings: Vec<Mapping>,
}

#[derive(Deserialize)]
struct Mapping {
    material: u32,
    variants: Vec<usize>,
}

/// Returns the names of the variants of a file, in its order; empty if the extension is invalid.
pub(crate) fn names(root: &Root) -> Vec<String> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let variants = extension.and_then(|extension| Variants::deserialize(extension).ok());
    variants.map_or_else(Vec::new, |list| list.variants.into_iter().map(|variant| variant.name).collect())
}

/// Returns the index of the variant of this name.
///
/// # Errors
/// Returns an error if there is no such variant.
pub(crate) fn index(names: &[String], wanted: &str) -> Result<usize, Cause> {
    names.iter().position(|name| name == wanted).ok_or_else(|| {
        let available = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
        let available = if available.is_empty() { "none".to_owned() } else { available };
        Cause::NoSuchVariant { wanted: wanted.to_owned(), available }
    })
}

/// Returns the material of a primitive in a variant, else its default material.
///
/// # Errors
/// Returns an error if the extension is invalid.
pub(crate) fn material(primitive: &Primitive, variant: Option<usize>, name: &str) -> Result<Option<usize>, Cause> {
    let plain = primitive.material.map(|material| material.value());
    let extension = primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let (Some(variant), Some(extension)) = (variant, extension) else { return Ok(plain) };
    let mappings = Mappings::deserialize(extension)
        .map_err(|error| Cause::Broken(format!("{name}: {EXTENSION}: {error}")))?
        .mappings;
    let chosen = mappings.iter().find(|mapping| mapping.variants.contains(&variant));
    Ok(chosen.map(|mapping| mapping.material as usize).or(plain))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::scene::gltf::fixture::Fixture;
    use crate::scene::gltf::{LoadOptions, from_slice_with};

    fn chair() -> Fixture {
        let mut fixture = Fixture::triangle();
        fixture.material(json!({"name": "oak"}));
        fixture.material(json!({"name": "ash"}));
        fixture.primitive()["material"] = json!(0);
        fixture.primitive()["extensions"] =
            json!({"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}});
        fixture.json["extensions"] =
            json!({"KHR_materials_variants": {"variants": [{"name": "dark"}, {"name": "light"}]}});
        fixture
    }

    fn material_with(variant: Option<&str>) -> Result<String, String> {
        let options = LoadOptions { variant: variant.map(str::to_owned) };
        let scene = from_slice_with("chair", &chair().to_bytes(), &options).map_err(|error| error.to_string())?;
        Ok(scene.materials[scene.triangles[0].material.index()].name.clone())
    }

    #[test]
    fn a_variant_replaces_the_materials_that_it_maps() {
        assert_eq!(material_with(None).as_deref(), Ok("oak"));
        assert_eq!(material_with(Some("dark")).as_deref(), Ok("oak"));
        assert_eq!(material_with(Some("light")).as_deref(), Ok("ash"));
        assert_eq!(chair().load().variants, ["dark", "light"]);
    }

    #[test]
    fn an_unknown_variant_is_an_error_that_lists_the_variants() {
        let error = material_with(Some("pink")).expect_err("there is none");
        assert!(error.contains("no variant \"pink\"; there is \"dark\", \"light\""), "{error}");
    }

    #[test]
    fn a_mapping_to_a_missing_material_is_reported() {
        let mut fixture = chair();
        fixture.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] = json!(9);
        let options = LoadOptions { variant: Some("light".to_owned()) };
        let error = from_slice_with("chair", &fixture.to_bytes(), &options).expect_err("broken").to_string();
        assert!(error.contains("refers to material 9"), "{error}");
    }
}
