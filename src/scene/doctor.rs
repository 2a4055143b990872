//! The mesh doctor: what in a scene will make its light wrong or slow, in plain English, and what to do about it.
//!
//! It only looks; nothing is repaired here.

use glam::Vec3;

use crate::scene::{Material, Scene, Texture};

/// Mean reflectance above which a material is doubted: fresh snow reflects 0.9, white paint 0.85.
const DOUBTFUL_REFLECTANCE: f32 = 0.9;

/// Diagonals of the bounding box outside which the unit is doubted, metres.
const PLAUSIBLE_DIAGONAL: std::ops::RangeInclusive<f32> = 0.2..=2000.0;

/// Most pixels of a texture that its mean is taken over.
const MEAN_PIXELS: usize = 1 << 16;

/// What the doctor found, as counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// Nothing is there to be lit.
    pub is_empty: bool,
    /// Triangles without area that the loader dropped.
    pub degenerate_triangles: usize,
    /// Triangles that lie exactly on another one and face the same way.
    pub duplicate_triangles: usize,
    /// Edges with a triangle on one side only, after welding equal positions.
    pub open_edges: usize,
    /// Edges where more than two triangles meet.
    pub non_manifold_edges: usize,
    /// Edges whose two triangles are wound against each other: one of them shows its back.
    pub inconsistent_windings: usize,
    /// Diagonal of the bounding box in metres, where it is no plausible size of a room or building.
    pub doubtful_diagonal: Option<f32>,
    /// Names of materials in use with a mean reflectance above 0.9.
    pub bright_materials: Vec<String>,
    /// Nothing emits.
    pub is_dark: bool,
    /// Textures whose image could not be read.
    pub missing_textures: usize,
}

/// Looks a scene over.
///
/// Cost: one sort of all edges; half a million triangles take a fraction of a second.
#[must_use]
pub fn examine(scene: &Scene) -> Findings {
    let (low, high) = scene.bounds();
    let diagonal = (high - low).length();
    let welded = welded_triangles(scene);
    let is_empty = scene.triangles.is_empty();
    let mut findings = Findings {
        is_empty,
        degenerate_triangles: scene.dropped_triangles,
        duplicate_triangles: count_duplicates(&welded),
        doubtful_diagonal: (!is_empty && !PLAUSIBLE_DIAGONAL.contains(&diagonal)).then_some(diagonal),
        bright_materials: bright_materials(scene),
        is_dark: scene.light_groups.is_empty(),
        missing_textures: scene.textures.iter().filter(|texture| texture.image.encoded.is_empty()).count(),
        ..Findings::default()
    };
    count_edges(&welded, &mut findings);
    findings
}

impl Findings {
    /// One sentence for each finding, with what to do about it; none for a healthy scene.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let counted = [
            ("triangles without area", self.degenerate_triangles, "they were dropped, nothing needs to be done"),
            ("duplicate triangles", self.duplicate_triangles, "delete doubles in the modeller"),
            (
                "open edges",
                self.open_edges,
                "harmless round free-standing sheets, but close gaps between walls, floor and ceiling",
            ),
            (
                "edges of more than two triangles",
                self.non_manifold_edges,
                "harmless in most scenes, but remove inner faces where light leaks",
            ),
            (
                "edges between a front and a back",
                self.inconsistent_windings,
                "recalculate normals outwards, or make the material double-sided",
            ),
            ("missing textures", self.missing_textures, "grey is used instead; put their files beside the scene"),
        ];
        let found = counted.into_iter().filter(|&(_, count, _)| count > 0);
        let mut lines: Vec<_> = found.map(|(what, count, advice)| format!("{what}: {count}; {advice}")).collect();
        if self.is_empty {
            lines.push("there are no triangles; check that the right scene was exported".to_owned());
        }
        if let Some(diagonal) = self.doubtful_diagonal {
            lines.push(format!(
                "the scene measures {diagonal:.3} m corner to corner; glTF is in metres, check the export scale"
            ));
        }
        if !self.bright_materials.is_empty() {
            let names = self.bright_materials.join(", ");
            lines.push(format!(
                "more than 0.9 of the light is reflected by: {names}; white paint has 0.85, darken them"
            ));
        }
        if self.is_dark {
            lines.push("nothing emits light; add a light or an emissive material and export lights too".to_owned());
        }
        lines
    }
}

/// Mean reflectance of each material, brightest channel: factors times texture means, vertex colours left out.
#[must_use]
pub fn mean_reflectances(scene: &Scene) -> Vec<f32> {
    let colour_means: Vec<_> = scene.textures.iter().map(|texture| mean(texture, Texture::sample_srgb)).collect();
    let data_means: Vec<_> = scene.textures.iter().map(|texture| mean(texture, Texture::sample_linear)).collect();
    let reflectance = |material: &Material| {
        let colour = material.base_colour_texture.map_or(Vec3::ONE, |slot| colour_means[slot.texture.index()]);
        let metallic = material.metallic_roughness_texture.map_or(1.0, |slot| data_means[slot.texture.index()].z);
        let reflected = material.base_colour.truncate() * colour * (1.0 - material.metallic * metallic);
        if material.unlit { 0.0 } else { reflected.max_element() }
    };
    scene.materials.iter().map(reflectance).collect()
}

/// Mean of a texture over a regular grid of its pixels.
fn mean(texture: &Texture, sample: impl Fn(&Texture, glam::Vec2) -> glam::Vec4) -> Vec3 {
    let (width, height) = (texture.image.width as usize, texture.image.height as usize);
    let step = (1..).find(|step| (width / step).max(1) * (height / step).max(1) <= MEAN_PIXELS).unwrap_or(1);
    let (columns, rows) = ((width / step).max(1), (height / step).max(1));
    let centre = |i: usize, n: usize| (i as f32 + 0.5) / n as f32;
    let sum: glam::Vec4 = (0..rows * columns)
        .map(|i| sample(texture, glam::Vec2::new(centre(i % columns, columns), centre(i / columns, rows))))
        .sum();
    sum.truncate() / (rows * columns) as f32
}

fn bright_materials(scene: &Scene) -> Vec<String> {
    let mut is_used = vec![false; scene.materials.len()];
    for triangle in &scene.triangles {
        is_used[triangle.material.index()] = true;
    }
    let reflectances = mean_reflectances(scene);
    let is_bright = |m: &usize| is_used[*m] && reflectances[*m] > DOUBTFUL_REFLECTANCE;
    (0..scene.materials.len()).filter(is_bright).map(|m| scene.materials[m].name.clone()).collect()
}

/// Triangles by welded vertices: corners at exactly equal positions get the same number. Written-out backs are skipped.
fn welded_triangles(scene: &Scene) -> Vec<[u32; 3]> {
    // Adding zero makes -0 equal +0 in bits.
    let bits = |v: u32| (scene.vertices[v as usize].position + 0.0).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..scene.vertices.len() as u32).collect();
    order.sort_unstable_by_key(|&v| bits(v));
    let mut welded = vec![0; order.len()];
    for pair in 1..order.len() {
        let (last, this) = (order[pair - 1], order[pair]);
        welded[this as usize] = welded[last as usize] + u32::from(bits(last) != bits(this));
    }
    let fronts = scene.triangles.iter().filter(|triangle| !triangle.is_back_side);
    fronts.map(|triangle| triangle.vertices.map(|v| welded[v as usize])).collect()
}

fn count_duplicates(triangles: &[[u32; 3]]) -> usize {
    let from_smallest = |&[a, b, c]: &[u32; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter().min();
    let mut sorted: Vec<_> = triangles.iter().map(from_smallest).collect();
    sorted.sort_unstable();
    sorted.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

fn count_edges(triangles: &[[u32; 3]], findings: &mut Findings) {
    let directed = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut edges: Vec<_> = directed.map(|(a, b)| (a.min(b), a.max(b), a < b)).collect();
    edges.sort_unstable();
    for uses in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        match uses {
            [_] => findings.open_edges += 1,
            [first, second] => findings.inconsistent_windings += usize::from(first.2 == second.2),
            _ => findings.non_manifold_edges += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec4};

    use super::*;
    use crate::base::ids::{InstanceId, MaterialId};
    use crate::scene::{Triangle, Vertex};

    /// A scene of white diffuse triangles over these positions, no vertex shared.
    fn soup(corners: &[[[f32; 3]; 3]]) -> Scene {
        let vertex = |position: [f32; 3]| Vertex {
            position: Vec3::from(position),
            normal: Vec3::Z,
            uv: [Vec2::ZERO; 2],
            colour: Vec4::ONE,
        };
        let triangle = |t: usize| Triangle {
            vertices: [0, 1, 2].map(|c| 3 * t as u32 + c),
            material: MaterialId(0),
            instance: InstanceId(0),
            is_back_side: false,
        };
        Scene {
            vertices: corners.iter().flatten().map(|&position| vertex(position)).collect(),
            triangles: (0..corners.len()).map(triangle).collect(),
            materials: vec![Material { name: "white".to_owned(), metallic: 0.0, ..Material::default() }],
            ..Scene::default()
        }
    }

    const O: [f32; 3] = [0.0, 0.0, 0.0];
    const X: [f32; 3] = [1.0, 0.0, 0.0];
    const Y: [f32; 3] = [0.0, 1.0, 0.0];
    const Z: [f32; 3] = [0.0, 0.0, 1.0];

    #[test]
    fn a_closed_tetrahedron_has_only_its_colour_and_darkness_wrong() {
        let findings = examine(&soup(&[[O, Y, X], [O, X, Z], [O, Z, Y], [X, Y, Z]]));
        let expected = Findings { is_dark: true, bright_materials: vec!["white".to_owned()], ..Findings::default() };
        assert_eq!(findings, expected);
        assert_eq!(findings.lines().len(), 2);
    }

    #[test]
    fn a_missing_face_opens_three_edges() {
        assert_eq!(examine(&soup(&[[O, Y, X], [O, X, Z], [O, Z, Y]])).open_edges, 3);
    }

    #[test]
    fn a_flipped_face_is_wound_against_its_three_neighbours() {
        let findings = examine(&soup(&[[O, X, Y], [O, X, Z], [O, Z, Y], [X, Y, Z]]));
        assert_eq!((findings.inconsistent_windings, findings.open_edges), (3, 0));
    }

    #[test]
    fn doubles_count_whichever_corner_comes_first_but_backs_do_not() {
        let mut scene = soup(&[[O, X, Y], [X, Y, O], [O, Y, X]]);
        let findings = examine(&scene);
        assert_eq!((findings.duplicate_triangles, findings.non_manifold_edges), (1, 3));
        scene.triangles[1].is_back_side = true;
        assert_eq!(examine(&scene).duplicate_triangles, 0);
    }

    #[test]
    fn three_sheets_at_an_edge_are_not_a_manifold() {
        let minus_y = [0.0, -1.0, 0.0];
        assert_eq!(examine(&soup(&[[O, X, Y], [O, X, Z], [X, O, minus_y]])).non_manifold_edges, 1);
    }

    #[test]
    fn a_scene_in_millimetres_is_doubted() {
        let findings = examine(&soup(&[[O, [4000.0, 0.0, 0.0], [0.0, 3000.0, 0.0]]]));
        assert_eq!(findings.doubtful_diagonal, Some(5000.0));
        assert!(findings.lines().iter().any(|line| line.contains("5000.000 m")));
    }

    #[test]
    fn an_empty_scene_is_said_to_be_empty() {
        let findings = examine(&Scene::default());
        assert!(findings.is_empty && findings.doubtful_diagonal.is_none());
    }
}
