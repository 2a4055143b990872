//! The mesh doctor: lists the defects that make the light of a scene wrong or slow to compute, with their locations and
//! advice.
//!
//! The doctor only reports; it repairs nothing.

mod edges;
mod finding;
mod lights;
mod overlaps;
mod surfaces;
#[cfg(test)]
mod tests;
mod weld;

pub use self::finding::{Finding, FindingKind, Findings, Location};
use self::weld::Welded;
use crate::base::ids::TriangleId;
use crate::scene::{Scene, normal_of};

/// Plausible diagonals of the bounding box, metres; outside this range the file's unit is probably wrong.
const PLAUSIBLE_DIAGONAL: std::ops::RangeInclusive<f32> = 0.2..=2000.0;

/// Examines a scene and returns all findings.
///
/// Cost: a few sorts of all edges and a search grid; half a million triangles take about a second.
#[must_use]
pub fn examine(scene: &Scene) -> Findings {
    let diagonal = scene.bounds().diagonal();
    let welded = Welded::new(scene);
    let edges = edges::Edges::new(&welded);
    let [open, non_manifold, flipped] = edges.findings(&welded);
    let all = [
        presence(FindingKind::Empty, scene.triangles.is_empty()),
        Finding { count: scene.dropped_triangles, ..Finding::new(FindingKind::DegenerateTriangle) },
        edges::duplicates(&welded),
        open,
        non_manifold,
        flipped,
        normals_against_winding(scene),
        edges.t_junctions(&welded, diagonal),
        overlaps::overlaps(&welded, diagonal),
        doubtful_scale(scene, diagonal),
        surfaces::bright_materials(scene),
        surfaces::missing_textures(scene),
        presence(FindingKind::Dark, scene.light_groups.is_empty()),
        lights::without_effect(scene),
    ];
    Findings { findings: all.into_iter().filter(|finding| finding.count > 0).collect() }
}

fn presence(kind: FindingKind, is_so: bool) -> Finding {
    Finding { count: usize::from(is_so), ..Finding::new(kind) }
}

fn doubtful_scale(scene: &Scene, diagonal: f32) -> Finding {
    let is_doubtful = !scene.triangles.is_empty() && !PLAUSIBLE_DIAGONAL.contains(&diagonal);
    Finding { detail: format!("{diagonal:.3} m corner to corner"), ..presence(FindingKind::DoubtfulScale, is_doubtful) }
}

fn normals_against_winding(scene: &Scene) -> Finding {
    let is_against = |t: &usize| {
        let face = normal_of(scene.corners(TriangleId::new(*t)));
        let vertices = scene.triangles[*t].vertices.map(|v| scene.vertices[v as usize].normal);
        vertices.iter().all(|normal| normal.dot(face) < 0.0)
    };
    let against: Vec<usize> = (0..scene.triangles.len()).filter(is_against).collect();
    let corners = |t: usize| Location::triangle(scene.corners(TriangleId::new(t)));
    Finding::counted(FindingKind::NormalAgainstWinding, against.into_iter().map(corners))
}
