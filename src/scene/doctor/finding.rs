//! A finding of the mesh doctor: its kind, how often it occurs, where, and the advice to the user.

use glam::Vec3;

/// Largest number of locations of a finding.
const MAX_LOCATIONS: usize = 10_000;

/// Kind of defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FindingKind {
    /// The scene has no triangles.
    Empty,
    /// A triangle without area, which the loader dropped.
    DegenerateTriangle,
    /// A triangle with the same three positions as another one and the same front.
    DuplicateTriangle,
    /// An edge of only one triangle, after equal positions are welded.
    OpenEdge,
    /// An edge of more than two triangles.
    NonManifoldEdge,
    /// An edge whose two triangles have opposite windings, so that one of them shows its back.
    FlippedWinding,
    /// A triangle whose vertex normals all point to its back.
    NormalAgainstWinding,
    /// A vertex inside an edge of another triangle.
    TJunction,
    /// A triangle that overlaps another in the same plane.
    CoplanarOverlap,
    /// The bounding box is implausibly small or large for a room or building.
    DoubtfulScale,
    /// A used material with a mean reflectance above 0.9.
    BrightMaterial,
    /// A texture whose image cannot be read.
    MissingTexture,
    /// The scene has no light and no emissive material.
    Dark,
    /// A light that reaches no surface, or an emissive material that no triangle uses.
    LightWithoutEffect,
}

impl FindingKind {
    /// Returns a description of the defect, and advice to the user.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Empty => ("there are no triangles", "check that the right scene was exported"),
            Self::DegenerateTriangle => ("triangles without area", "they are dropped; you need not do anything"),
            Self::DuplicateTriangle => ("duplicate triangles", "delete the duplicates in the modeller"),
            Self::OpenEdge => {
                ("open edges", "harmless around free-standing sheets; close gaps between walls, floor and ceiling")
            }
            Self::NonManifoldEdge => {
                ("edges of more than two triangles", "harmless in most scenes; remove inner faces if light leaks there")
            }
            Self::FlippedWinding => {
                ("edges between a front and a back", "recalculate normals outwards, or make the material double-sided")
            }
            Self::NormalAgainstWinding => (
                "triangles with normals against their winding",
                "recalculate normals outwards; the winding decides which side is the front",
            ),
            Self::TJunction => (
                "vertices inside an edge of another triangle",
                "they may show as cracks; split the edge at the vertex, or weld both in the modeller",
            ),
            Self::CoplanarOverlap => (
                "triangles that overlap another in the same plane",
                "they flicker; move one by a millimetre, or delete the overlap",
            ),
            Self::DoubtfulScale => ("the scene measures", "glTF lengths are in metres; check the scale of the export"),
            Self::BrightMaterial => {
                ("materials that reflect more than 0.9 of the light", "white paint reflects 0.85; darken them")
            }
            Self::MissingTexture => ("missing textures", "grey is shown instead; put the files beside the scene"),
            Self::Dark => {
                ("nothing emits light", "add a light or an emissive material, and include lights in the export")
            }
            Self::LightWithoutEffect => (
                "lights without effect",
                "no surface lies in their range or cone, or no triangle uses the material; move or delete them",
            ),
        }
    }
}

/// Location of a defect as line segments to draw; a point is a segment of length zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Location {
    /// End points of the segments, metres.
    pub lines: Vec<[Vec3; 2]>,
}

impl Location {
    pub(super) fn segment(ends: [Vec3; 2]) -> Self {
        Self { lines: vec![ends] }
    }

    pub(super) fn triangle([a, b, c]: [Vec3; 3]) -> Self {
        Self { lines: vec![[a, b], [b, c], [c, a]] }
    }
}

/// All defects of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Kind of defect.
    pub kind: FindingKind,
    /// Number of defects; never zero in [`Findings`].
    pub count: usize,
    /// Names or sizes for the message; may be empty.
    pub detail: String,
    /// Locations of the first ten thousand; empty if this kind of defect has no location.
    pub locations: Vec<Location>,
}

impl Finding {
    pub(super) fn new(kind: FindingKind) -> Self {
        Self { kind, count: 0, detail: String::new(), locations: Vec::new() }
    }

    pub(super) fn counted(kind: FindingKind, locations: impl Iterator<Item = Location> + Clone) -> Self {
        let mut finding = Self { count: locations.clone().count(), ..Self::new(kind) };
        finding.show(locations);
        finding
    }

    pub(super) fn show(&mut self, locations: impl Iterator<Item = Location>) {
        self.locations = locations.take(MAX_LOCATIONS).collect();
    }

    /// Returns the message of one line: count and advice.
    #[must_use]
    pub fn line(&self) -> String {
        let (what, advice) = self.kind.words();
        match (self.kind, self.detail.is_empty()) {
            (FindingKind::Empty | FindingKind::Dark, _) => format!("{what}; {advice}"),
            (FindingKind::DoubtfulScale, _) => format!("{what} {}; {advice}", self.detail),
            (_, true) => format!("{what}: {}; {advice}", self.count),
            (_, false) => format!("{what}: {} ({}); {advice}", self.count, self.detail),
        }
    }
}

/// Findings of the doctor; empty for a sound scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// One finding per kind, in the order of [`FindingKind`].
    pub findings: Vec<Finding>,
}

impl Findings {
    /// Returns the number of defects of a kind.
    #[must_use]
    pub fn count(&self, kind: FindingKind) -> usize {
        self.findings.iter().filter(|finding| finding.kind == kind).map(|finding| finding.count).sum()
    }

    /// Returns the messages, one line per finding.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        self.findings.iter().map(Finding::line).collect()
    }
}
