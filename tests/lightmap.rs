//! Lightmaps: the files that the program writes, and the light of the texture compared with the light at the vertices.

use std::path::Path;
use std::process::Command;

use glam::Vec3;
use gltf::Semantic;
use hemicube::bake::{BakeSettings, Method, Quality, bake};
use hemicube::base::colour::luminance;
use hemicube::base::sampling::{r2, triangle_from_square};
use hemicube::base::triangle::{barycentric, interpolate};
use hemicube::lightmap::{LightmapSettings, lightmap};
use hemicube::scene::builtin;

#[test]
fn the_texture_shows_the_light_at_the_vertices() {
    let scene = builtin::by_name("cornell").expect("it is built in");
    let settings = BakeSettings { method: Some(Method::Hemisphere), ..BakeSettings::preset(Quality::Draft) };
    let bake = bake(&scene, &settings).expect("it bakes");
    let size = settings.mesh_settings(&scene).element_size;
    let map = lightmap(&scene, &bake.mesh, &bake.baked.light, &LightmapSettings::for_elements(size)).expect("it fits");

    // Compares, at random points of every element, the light interpolated between its vertices with the light of the
    // texture. Texture coordinates come from the large triangle that contains the element.
    let (mut deviations, mut mean) = (Vec::new(), 0.0);
    for (e, element) in bake.mesh.elements.iter().enumerate() {
        let corners = bake.mesh.corners(element);
        let whole = map.scene.corners(element.triangle);
        let coordinates = map.scene.triangles[element.triangle.index()].vertices.map(|v| map.coordinates[v as usize]);
        let weights = triangle_from_square(r2(e as u32, 11));
        let place = interpolate(corners, weights);
        let at = barycentric(whole, place);
        let shown = map.texels.sample(interpolate(coordinates, at));
        let of_vertex = |v: u32| -> Vec3 {
            let groups = &bake.baked.light.groups;
            groups.iter().map(|group| group.direct[v as usize] + group.indirect[v as usize]).sum()
        };
        let [a, b, c] = element.vertices.map(of_vertex);
        let stored = interpolate([a, b, c], weights);
        let area = hemicube::scene::area_of(corners);
        mean += area * luminance(stored);
        deviations.push((luminance((shown - stored).abs()), area));
    }
    let area: f32 = deviations.iter().map(|&(_, area)| area).sum();
    let mean = mean / area;
    let mean_deviation = deviations.iter().map(|&(deviation, area)| deviation * area).sum::<f32>() / area / mean;
    deviations.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut below = 0.0;
    let most = deviations.iter().find(|&&(_, area_of)| {
        below += area_of;
        below >= 0.99 * area
    });
    let most = most.expect("there are elements").0 / mean;
    println!("mean deviation {mean_deviation}, stated {}, 99 % below {most} of the mean light", map.deviation);
    assert!(mean_deviation < 0.01 && most < 0.1, "mean {mean_deviation}, 99 % below {most}");
    assert!((map.deviation / mean_deviation - 1.0).abs() < 0.2, "stated {}, found {mean_deviation}", map.deviation);
}

/// Bakes the built-in Cornell box to `lit.glb` with a lightmap beside it.
fn baked(folder: &Path) {
    let output = Command::new(env!("CARGO_BIN_EXE_hemicube"))
        .args("bake builtin:cornell --quality draft --method hemisphere --exposure=-1 --lightmap -o lit.glb".split(' '))
        .current_dir(folder)
        .output()
        .expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("lit-lightmap.glb: ") && message.contains("off the light at vertices"), "{message}");
}

#[test]
fn the_file_names_its_texture_and_its_brightness() {
    let folder = tempfile::tempdir().expect("a folder");
    baked(folder.path());
    let file = gltf::Gltf::open(folder.path().join("lit-lightmap.glb")).expect("valid glTF");
    let blob = file.blob.as_deref().expect("a binary half");
    assert!(file.extensions_used().any(|used| used == "MOZ_lightmap"));
    assert_eq!(file.extensions_required().count(), 0);
    let scene = builtin::by_name("cornell").expect("it is built in");
    let num_triangles: usize = file
        .meshes()
        .flat_map(|mesh| mesh.primitives().map(|p| p.indices().map_or(0, |i| i.count() / 3)).collect::<Vec<_>>())
        .sum();
    assert_eq!(num_triangles, scene.triangles.len());

    // Every lit material refers to the texture, the second set of coordinates, and the light that white stands for.
    let told: Vec<_> = file
        .materials()
        .filter_map(|material| material.extension_value("MOZ_lightmap").cloned())
        .map(|told| {
            (told["index"].as_u64(), told["texCoord"].as_u64(), told["intensity"].as_f64().expect("a number") as f32)
        })
        .collect();
    assert_eq!(told.len(), file.materials().filter(|material| material.index().is_some()).count());
    assert!(told.iter().all(|other| *other == told[0]), "{told:?}");
    let (Some(index), Some(1), intensity) = told[0] else { panic!("{told:?}") };
    let texture = file.textures().nth(index as usize).expect("it is there");
    let gltf::image::Source::View { view, mime_type: "image/png" } = texture.source().source() else { panic!("a PNG") };
    let picture = image::load_from_memory(&blob[view.offset()..][..view.length()]).expect("a PNG").into_rgb8();
    for primitive in file.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        assert!(primitive.get(&Semantic::TexCoords(0)).is_some() && primitive.get(&Semantic::Colors(0)).is_none());
        let accessor = primitive.get(&Semantic::TexCoords(1)).expect("a second set of coordinates");
        let bytes = &blob[accessor.view().expect("bytes").offset()..][..8 * accessor.count()];
        let inside = |x: &f32| (0.0..=1.0).contains(x);
        assert!(bytemuck::pod_collect_to_vec::<u8, f32>(bytes).iter().all(inside));
    }

    // The texture in the file and the one in lux beside it hold the same light.
    let lux = image::open(folder.path().join("lit-lightmap.exr")).expect("an EXR").into_rgb32f();
    assert_eq!(lux.dimensions(), picture.dimensions());
    let white = 2.0 * intensity;
    for (stored, exact) in picture.pixels().zip(lux.pixels()) {
        for (stored, exact) in stored.0.iter().zip(exact.0) {
            let shown = f32::from(*stored) / 255.0 * white;
            assert!((shown - exact.min(white)).abs() <= 1.001 * white / 255.0, "{shown} and {exact} lux");
        }
    }
}
