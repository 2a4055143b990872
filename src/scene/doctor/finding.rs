//! What the doctor finds: its kind, how often, where, and what to do about it.

use glam::Vec3;

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
    pub(super) fn segment(ends: [Vec3; 2]) -> Self {
        Self { lines: vec![ends] }
    }

    pub(super) fn triangle([a, b, c]: [Vec3; 3]) -> Self {
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
    pub(super) fn new(kind: Kind) -> Self {
        Self { kind, count: 0, detail: String::new(), places: Vec::new() }
    }

    pub(super) fn counted(kind: Kind, places: impl Iterator<Item = Place> + Clone) -> Self {
        let mut finding = Self { count: places.clone().count(), ..Self::new(kind) };
        finding.show(places);
        finding
    }

    pub(super) fn show(&mut self, places: impl Iterator<Item = Place>) {
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
