//! The mesh doctor: what in a scene will make its light wrong or slow, in plain English, where it is, and what to do.
//!
//! It only looks; nothing is repaired here.

mod edges;
mod lights;
mod overlaps;
mod surfaces;
#[cfg(test)]
mod tests;
mod weld;

use glam::Vec3;

pub use self::surfaces::mean_reflectances;
use self::weld::Welded;
use crate::base::ids::TriangleId;
use crate::scene::{Scene, normal_of};

/// Diagonals of the bounding box outside which the unit is doubted, metres.
const PLAUSIBLE_DIAGONAL: std::ops::RangeInclusive<f32> = 0.2..=2000.0;

/// Most places of a finding that are kept to be shown.
const MAX_PLACES: usize = 10_000;

/// Something that the doctor looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Nothing is there to be lit.
    Empty,
    /// A triangle without area, dropped by the loader.
    DegenerateTriangle,
    /// A triangle that lies exactly on another one and faces the same way.
    DuplicateTriangle,
    /// An edge with a triangle on one side only, after welding equal positions.
    OpenEdge,
    /// An edge where more than two triangles meet.
    NonManifoldEdge,
    /// An edge whose two triangles are wound against each other: one of them shows its back.
    FlippedWinding,
    /// A triangle whose vertex normals say that its back is its front.
    NormalAgainstWinding,
    /// A vertex inside an edge of another triangle.
    TJunction,
    /// A triangle that overlaps another in the same plane.
    CoplanarOverlap,
    /// The bounding box has no plausible size of a room or building.
    DoubtfulScale,
    /// A material in use reflects more than 0.9 on average.
    BrightMaterial,
    /// A texture whose image could not be read.
    MissingTexture,
    /// Nothing emits.
    Dark,
    /// A light that no surface can receive, or an emissive material that nothing wears.
    LightWithoutEffect,
}

impl Kind {
    /// What is counted, and what to do about it.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Empty => ("there are no triangles", "check that the right scene was exported"),
            Self::DegenerateTriangle => ("triangles without area", "they were dropped, nothing needs to be done"),
            Self::DuplicateTriangle => ("duplicate triangles", "delete doubles in the modeller"),
            Self::OpenEdge => {
                ("open edges", "harmless round free-standing sheets, but close gaps between walls, floor and ceiling")
            }
            Self::NonManifoldEdge => (
                "edges of more than two triangles",
                "harmless in most scenes, but remove inner faces where light leaks",
            ),
            Self::FlippedWinding => {
                ("edges between a front and a back", "recalculate normals outwards, or make the material double-sided")
            }
            Self::NormalAgainstWinding => (
                "triangles with normals against their winding",
                "recalculate normals outwards; the winding decides which side is the front",
            ),
            Self::TJunction => (
                "vertices inside an edge of another triangle",
                "they may show as cracks; split the edge there, or weld in the modeller",
            ),
            Self::CoplanarOverlap => (
                "triangles that overlap another in the same plane",
                "they flicker; move one a millimetre, or cut it out",
            ),
            Self::DoubtfulScale => ("the scene measures", "glTF is in metres, check the export scale"),
            Self::BrightMaterial => {
                ("materials that reflect more than 0.9 of the light", "white paint has 0.85, darken them")
            }
            Self::MissingTexture => ("missing textures", "grey is used instead; put their files beside the scene"),
            Self::Dark => ("nothing emits light", "add a light or an emissive material and export lights too"),
            Self::LightWithoutEffect => (
                "lights without effect",
                "no surface lies in their range or cone, or nothing wears the material; move or delete them",
            ),
        }
    }
}

/// Where something is, as lines to draw; a point is a line without length.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Ends of lines, metres.
    pub lines: Vec<[Vec3; 2]>,
}

impl Place {
    fn segment(ends: [Vec3; 2]) -> Self {
        Self { lines: vec![ends] }
    }

    fn triangle([a, b, c]: [Vec3; 3]) -> Self {
        Self { lines: vec![[a, b], [b, c], [c, a]] }
    }
}

/// Something that the doctor found.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is.
    pub kind: Kind,
    /// How often it was found; never zero in [`Findings`].
    pub count: usize,
    /// Names or sizes that belong to it; may be empty.
    pub detail: String,
    /// Where it is: the first ten thousand places, none where it has no place.
    pub places: Vec<Place>,
}

impl Finding {
    fn new(kind: Kind) -> Self {
        Self { kind, count: 0, detail: String::new(), places: Vec::new() }
    }

    fn counted(kind: Kind, places: impl Iterator<Item = Place> + Clone) -> Self {
        let mut finding = Self { count: places.clone().count(), ..Self::new(kind) };
        finding.show(places);
        finding
    }

    fn show(&mut self, places: impl Iterator<Item = Place>) {
        self.places = places.take(MAX_PLACES).collect();
    }

    /// One sentence with the count and what to do.
    #[must_use]
    pub fn line(&self) -> String {
        let (what, advice) = self.kind.words();
        match (self.kind, self.detail.is_empty()) {
            (Kind::Empty | Kind::Dark, _) => format!("{what}; {advice}"),
            (Kind::DoubtfulScale, _) => format!("{what} {}; {advice}", self.detail),
            (_, true) => format!("{what}: {}; {advice}", self.count),
            (_, false) => format!("{what}: {} ({}); {advice}", self.count, self.detail),
        }
    }
}

/// What the doctor found; nothing for a healthy scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// In a fixed order of kinds.
    pub findings: Vec<Finding>,
}

impl Findings {
    /// How often a kind was found.
    #[must_use]
    pub fn count(&self, kind: Kind) -> usize {
        self.findings.iter().filter(|finding| finding.kind == kind).map(|finding| finding.count).sum()
    }

    /// One sentence for each finding.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        self.findings.iter().map(Finding::line).collect()
    }
}

/// Looks a scene over.
///
/// Cost: some sorts of all edges and a search grid; half a million triangles take about a second.
#[must_use]
pub fn examine(scene: &Scene) -> Findings {
    let (low, high) = scene.bounds();
    let diagonal = (high - low).length();
    let welded = Welded::new(scene);
    let edges = edges::Edges::new(&welded);
    let [open, non_manifold, flipped] = edges.findings(&welded);
    let all = [
        presence(Kind::Empty, scene.triangles.is_empty()),
        Finding { count: scene.dropped_triangles, ..Finding::new(Kind::DegenerateTriangle) },
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
        presence(Kind::Dark, scene.light_groups.is_empty()),
        lights::without_effect(scene),
    ];
    Findings { findings: all.into_iter().filter(|finding| finding.count > 0).collect() }
}

fn presence(kind: Kind, is_so: bool) -> Finding {
    Finding { count: usize::from(is_so), ..Finding::new(kind) }
}

fn doubtful_scale(scene: &Scene, diagonal: f32) -> Finding {
    let is_doubtful = !scene.triangles.is_empty() && !PLAUSIBLE_DIAGONAL.contains(&diagonal);
    Finding { detail: format!("{diagonal:.3} m corner to corner"), ..presence(Kind::DoubtfulScale, is_doubtful) }
}

fn normals_against_winding(scene: &Scene) -> Finding {
    let is_against = |t: &usize| {
        let face = normal_of(scene.corners(TriangleId::new(*t)));
        let vertices = scene.triangles[*t].vertices.map(|v| scene.vertices[v as usize].normal);
        vertices.iter().all(|normal| normal.dot(face) < 0.0)
    };
    let against: Vec<usize> = (0..scene.triangles.len()).filter(is_against).collect();
    let corners = |t: usize| Place::triangle(scene.corners(TriangleId::new(t)));
    Finding::counted(Kind::NormalAgainstWinding, against.into_iter().map(corners))
}
