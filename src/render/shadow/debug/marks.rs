//! Lines and tinted faces of debug views.

use std::collections::HashMap;

use glam::{Vec3, Vec4};

use super::DebugView;
use crate::render::Mark;
use crate::render::shadow::casters::Casters;
use crate::render::shadow::flattening::{Receiver, receivers};
use crate::render::shadow::light_samples::LightSample;
use crate::render::shadow::silhouette::{facing, silhouette};
use crate::render::shadow::{PlanarSettings, ShadowScene, ShadowSettings};
use crate::scene::Scene;

const EDGE: [u8; 4] = [255, 226, 90, 255];
const SIDE: [u8; 4] = [255, 120, 60, 26];
/// Colours of receivers, one after the other.
const RECEIVERS: [[u8; 3]; 6] =
    [[90, 190, 255], [255, 170, 70], [130, 220, 110], [235, 120, 220], [245, 225, 90], [110, 235, 215]];
const RECEIVER_ALPHA: u8 = 70;
/// Sides are drawn this many times as long as the scene is wide; volumes have no end.
const REACH: f32 = 2.0;

/// What marks are made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    view: DebugView,
    place: Vec4,
    planar: PlanarSettings,
}

/// Lines, two corners each, and triangles, three corners each.
#[derive(Default)]
pub struct Marks {
    pub lines: Vec<Mark>,
    pub triangles: Vec<Mark>,
}

impl Source {
    pub fn new(view: DebugView, settings: &ShadowSettings, sample: &LightSample) -> Self {
        Self { view, place: sample.place(), planar: settings.planar.clone() }
    }
}

impl Marks {
    pub fn of(shadows: &ShadowScene, source: &Source) -> Self {
        let mut marks = Self::default();
        match source.view {
            DebugView::Volumes => marks.volumes(shadows, source.place),
            DebugView::Silhouettes => marks.silhouettes(&shadows.casters, source.place),
            DebugView::Receivers => {
                let scene = shadows.scene();
                for (receiver, colour) in receivers(scene, &source.planar).iter().zip(RECEIVERS.into_iter().cycle()) {
                    marks.receiver(scene, receiver, colour);
                }
            }
            DebugView::StencilCounts | DebugView::Map => {}
        }
        marks
    }

    fn silhouettes(&mut self, casters: &Casters, light: Vec4) {
        let edges = silhouette(casters, &facing(casters, light));
        self.lines.extend(edges.iter().flatten().map(|&corner| mark(casters.positions[corner as usize], EDGE)));
    }

    fn volumes(&mut self, shadows: &ShadowScene, light: Vec4) {
        let casters = &shadows.casters;
        let reach = REACH * shadows.scene().bounds().diagonal();
        let far = |corner: Vec3| corner + reach * (light.w * corner - light.truncate()).normalize_or_zero();
        for ends in silhouette(casters, &facing(casters, light)) {
            let [a, b] = ends.map(|corner| casters.positions[corner as usize]);
            self.triangles.extend([a, b, far(b), a, far(b), far(a)].map(|corner| mark(corner, SIDE)));
        }
        self.silhouettes(casters, light);
    }

    fn receiver(&mut self, scene: &Scene, receiver: &Receiver, [r, g, b]: [u8; 3]) {
        let key = |p: Vec3| p.to_array().map(f32::to_bits);
        let mut edges: HashMap<_, (u32, [Vec3; 2])> = HashMap::new();
        for corners in receiver.triangles.iter().map(|&id| scene.corners(id)) {
            self.triangles.extend(corners.map(|corner| mark(corner, [r, g, b, RECEIVER_ALPHA])));
            for (p, q) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j])) {
                edges.entry((key(p).min(key(q)), key(p).max(key(q)))).or_insert((0, [p, q])).0 += 1;
            }
        }
        // An edge of one triangle only is an edge of the receiver.
        let outline = edges.into_values().filter(|(uses, _)| *uses == 1).flat_map(|(_, ends)| ends);
        self.lines.extend(outline.map(|corner| mark(corner, [r, g, b, 255])));
    }
}

fn mark(position: Vec3, colour: [u8; 4]) -> Mark {
    Mark { position, colour }
}
