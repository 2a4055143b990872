//! Writes materials, textures, samplers and images.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Cursor;
use std::sync::Arc;

use glam::{Affine2, Vec3};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use serde_json::{Map, Value, json};

use super::binary::Binary;
use super::json::{Extensions, named};
use super::{node, unlit};
use crate::scene::{AlphaMode, Image, Material, Sampler, Scene, TextureSlot, Wrap};

/// The arrays of glTF that describe surfaces.
pub(super) struct Surfaces {
    pub images: Vec<Value>,
    pub samplers: Vec<Value>,
    pub textures: Vec<Value>,
    pub materials: Vec<Value>,
}

/// Returns the surfaces of a scene. The materials of a bake are unlit, because the vertex colours hold the light.
pub(super) fn surfaces(scene: &Scene, is_baked: bool, binary: &mut Binary, used: &mut Extensions) -> Surfaces {
    let unique = unique_images(scene);
    Surfaces {
        images: images(&unique, binary),
        samplers: samplers(scene),
        textures: textures(scene, &unique),
        materials: materials(scene, is_baked, used),
    }
}

/// Returns the texture slots that a material uses.
pub(super) fn texture_slots(material: &Material) -> impl Iterator<Item = &TextureSlot> {
    let normal = material.normal_texture.as_ref().map(|(slot, _)| slot);
    let others = [&material.base_colour_texture, &material.metallic_roughness_texture, &material.emissive_texture];
    others.into_iter().flatten().chain(normal)
}

/// Distinct images, with their index by address.
struct UniqueImages<'a> {
    images: Vec<&'a Image>,
    number: HashMap<*const Image, usize>,
}

/// Returns the different images of all textures.
fn unique_images(scene: &Scene) -> UniqueImages<'_> {
    let mut unique = UniqueImages { images: Vec::new(), number: HashMap::new() };
    for texture in &scene.textures {
        unique.number.entry(Arc::as_ptr(&texture.image)).or_insert_with(|| {
            unique.images.push(&texture.image);
            unique.images.len() - 1
        });
    }
    unique
}

/// Returns the images. Those in PNG and JPEG keep their encoding, because every viewer can read it; others become PNG.
fn images(unique: &UniqueImages<'_>, binary: &mut Binary) -> Vec<Value> {
    let embedded = |image: &&Image| {
        let is_plain = !image.encoded.is_empty() && matches!(image.mime_type.as_str(), "image/png" | "image/jpeg");
        let (encoded, mime_type) = if is_plain {
            (Cow::Borrowed(&image.encoded), image.mime_type.as_str())
        } else {
            (Cow::Owned(png(&image.rgba, image.width, image.height, ExtendedColorType::Rgba8)), "image/png")
        };
        let mut object = named(&image.name);
        object["bufferView"] = json!(binary.push_file(&encoded));
        object["mimeType"] = json!(mime_type);
        object
    };
    unique.images.iter().map(embedded).collect()
}

/// Returns the bytes of a PNG file.
pub(super) fn png(pixels: &[u8], width: u32, height: u32, kind: ExtendedColorType) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    PngEncoder::new(&mut file)
        .write_image(pixels, width, height, kind)
        .expect("an image has as many pixels as its size, and writing to memory succeeds");
    file.into_inner()
}

/// One glTF texture for each texture, with its image and its sampler.
fn textures(scene: &Scene, unique: &UniqueImages<'_>) -> Vec<Value> {
    let samplers = unique_samplers(scene);
    let object = |texture: &crate::scene::Texture| {
        let sampler = samplers.iter().position(|sampler| *sampler == texture.sampler);
        json!({ "source": unique.number[&Arc::as_ptr(&texture.image)], "sampler": sampler })
    };
    scene.textures.iter().map(object).collect()
}

/// Returns the different samplers in use.
fn samplers(scene: &Scene) -> Vec<Value> {
    unique_samplers(scene).into_iter().map(sampler).collect()
}

fn unique_samplers(scene: &Scene) -> Vec<Sampler> {
    let mut unique = Vec::new();
    for texture in &scene.textures {
        if !unique.contains(&texture.sampler) {
            unique.push(texture.sampler);
        }
    }
    unique
}

fn sampler(sampler: Sampler) -> Value {
    const NEAREST: u32 = 9728;
    const LINEAR: u32 = 9729;
    const LINEAR_MIPMAP_LINEAR: u32 = 9987;
    let wrap = |wrap| match wrap {
        Wrap::Repeat => 10497,
        Wrap::Mirror => 33648,
        Wrap::Clamp => 33071,
    };
    let (mag, min) = if sampler.nearest { (NEAREST, NEAREST) } else { (LINEAR, LINEAR_MIPMAP_LINEAR) };
    json!({ "wrapS": wrap(sampler.wrap_u), "wrapT": wrap(sampler.wrap_v), "magFilter": mag, "minFilter": min })
}

/// Returns all materials; those of a bake show the light in their vertex colours.
fn materials(scene: &Scene, is_baked: bool, used: &mut Extensions) -> Vec<Value> {
    let object = |material| {
        let object = object(scene, material, used);
        if is_baked { showing_light(object, material, used) } else { object }
    };
    scene.materials.iter().map(object).collect()
}

/// Returns an unlit material whose colour comes only from vertices and texture. The original values are in `extras`.
fn showing_light(mut object: Value, material: &Material, used: &mut Extensions) -> Value {
    const UNLIT: &str = "KHR_materials_unlit";
    let mut paint = json!({
        "base_colour": material.base_colour.to_array(),
        "double_sided": material.double_sided,
        "unlit": material.unlit,
    });
    let pbr = &mut object["pbrMetallicRoughness"];
    pbr["baseColorFactor"] = json!([1.0, 1.0, 1.0, material.base_colour.w]);
    if let Some(slot) = material.emissive_texture.filter(|_| unlit::shows_emission(material)) {
        paint["shows_emission"] = json!(true);
        paint["base_colour_texture"] = pbr["baseColorTexture"].take();
        pbr["baseColorTexture"] = texture_info(&slot, used);
    }
    // The back of a double-sided surface is stored as separate triangles.
    if let Some(object) = object.as_object_mut() {
        object.remove("doubleSided");
    }
    object["extras"]["paint"] = paint;
    object["extensions"][UNLIT] = json!({});
    used.insert(UNLIT);
    object
}

fn object(scene: &Scene, material: &Material, used: &mut Extensions) -> Value {
    let mut object = named(&material.name);
    object["pbrMetallicRoughness"] = metallic_roughness(material, used);
    if let Some((slot, scale)) = &material.normal_texture {
        let mut info = texture_info(slot, used);
        info["scale"] = json!(scale);
        object["normalTexture"] = info;
    }
    if let Some(slot) = &material.emissive_texture {
        object["emissiveTexture"] = texture_info(slot, used);
    }
    if material.is_emissive() {
        // The factor is at most one per channel; the remaining factor is the emissive strength.
        object["emissiveFactor"] = json!((material.emission / strength(material.emission)).to_array());
    }
    if let Some(group) = material.group {
        object["extras"] = json!({ "light_group": node::group_name(scene, group) });
    }
    if material.double_sided {
        object["doubleSided"] = json!(true);
    }
    match material.alpha_mode {
        AlphaMode::Opaque => {}
        AlphaMode::Mask { cutoff } => {
            object["alphaMode"] = json!("MASK");
            object["alphaCutoff"] = json!(cutoff);
        }
        AlphaMode::Blend => object["alphaMode"] = json!("BLEND"),
    }
    let extensions = extensions(material);
    if !extensions.is_empty() {
        used.extend(extensions.iter().map(|(name, _)| *name));
        object["extensions"] = extensions.into_iter().map(|(name, body)| (name.to_owned(), body)).collect();
    }
    object
}

fn metallic_roughness(material: &Material, used: &mut Extensions) -> Value {
    let mut object = Map::new();
    object.insert("baseColorFactor".into(), json!(material.base_colour.to_array()));
    object.insert("metallicFactor".into(), json!(material.metallic));
    object.insert("roughnessFactor".into(), json!(material.roughness));
    if let Some(slot) = &material.base_colour_texture {
        object.insert("baseColorTexture".into(), texture_info(slot, used));
    }
    if let Some(slot) = &material.metallic_roughness_texture {
        object.insert("metallicRoughnessTexture".into(), texture_info(slot, used));
    }
    Value::Object(object)
}

/// Extensions for properties that differ from the defaults of glTF.
fn extensions(material: &Material) -> Vec<(&'static str, Value)> {
    let plain = Material::default();
    let mut extensions = Vec::new();
    if strength(material.emission) > 1.0 {
        let body = json!({ "emissiveStrength": strength(material.emission) });
        extensions.push(("KHR_materials_emissive_strength", body));
    }
    if material.unlit {
        extensions.push(("KHR_materials_unlit", json!({})));
    }
    if material.transmission != plain.transmission {
        extensions.push(("KHR_materials_transmission", json!({ "transmissionFactor": material.transmission })));
    }
    if material.ior != plain.ior {
        extensions.push(("KHR_materials_ior", json!({ "ior": material.ior })));
    }
    extensions
}

/// Emissive strength of an emission, nit per channel.
fn strength(emission: Vec3) -> f32 {
    emission.max_element().max(1.0)
}

fn texture_info(slot: &TextureSlot, used: &mut Extensions) -> Value {
    let mut info = json!({ "index": slot.texture.index() });
    if slot.uv_set != 0 {
        info["texCoord"] = json!(slot.uv_set);
    }
    if slot.transform != Affine2::IDENTITY {
        const NAME: &str = "KHR_texture_transform";
        used.insert(NAME);
        // The rotation of glTF is clockwise, as seen with V down.
        let (scale, angle, offset) = slot.transform.to_scale_angle_translation();
        info["extensions"] = json!({
            NAME: { "offset": offset.to_array(), "rotation": -angle, "scale": scale.to_array() }
        });
    }
    info
}
