//! Lines and tinted faces of the debug views of volumes, silhouettes and receivers.

use std::collections::HashMap;

use glam::{Vec3, Vec4};

use super::view::DebugView;
use crate::render::Mark;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::planar::receivers::{Receiver, receivers};
use crate::render::shadow::planar::settings::PlanarSettings;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::casters::Casters;
use crate::render::shadow::shared::scene::ShadowScene;
use crate::render::shadow::volume::silhouette::{facing, silhouette};
use crate::scene::Scene;

const EDGE: [u8; 4] = [255, 226, 90, 255];
const SIDE: [u8; 4] = [255, 120, 60, 26];
/// Colours of the receivers, used in turn.
const RECEIVERS: [[u8; 3]; 6] =
    [[90, 190, 255], [255, 170, 70], [130, 220, 110], [235, 120, 220], [245, 225, 90], [110, 235, 215]];
const RECEIVER_ALPHA: u8 = 70;
/// Length of the drawn sides, in diagonals of the scene. The sides of a volume itself are infinite.
const REACH: f32 = 2.0;

/// What the marks of a view depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct MarksKey {
    view: DebugView,
    light: Vec4,
    planar: PlanarSettings,
}

/// Corners of lines and triangles.
#[derive(Default)]
pub struct Marks {
    /// Corners of the lines, two each.
    pub lines: Vec<Mark>,
    /// Corners of the triangles, three each.
    pub triangles: Vec<Mark>,
}

impl MarksKey {
    /// Returns the key for the view of one light sample.
    pub fn new(view: DebugView, settings: &ShadowSettings, sample: &LightSample) -> Self {
        Self { view, light: sample.position(), planar: settings.planar.clone() }
    }
}

impl Marks {
    /// Returns the marks of a view. Views that colour pixels have no marks.
    pub fn new(shadows: &ShadowScene, key: &MarksKey) -> Self {
        let mut marks = Self::default();
        match key.view {
            DebugView::Volumes => marks.volumes(shadows, key.light),
            DebugView::Silhouettes => marks.silhouettes(shadows.casters(), key.light),
            DebugView::Receivers => {
                let scene = shadows.scene();
                for (receiver, colour) in receivers(scene, &key.planar).iter().zip(RECEIVERS.into_iter().cycle()) {
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
        let casters = shadows.casters();
        let reach = REACH * shadows.bounds().diagonal();
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
        // The outline of a receiver consists of the edges that belong to one triangle only.
        let outline = edges.into_values().filter(|(uses, _)| *uses == 1).flat_map(|(_, ends)| ends);
        self.lines.extend(outline.map(|corner| mark(corner, [r, g, b, 255])));
    }
}

fn mark(position: Vec3, colour: [u8; 4]) -> Mark {
    Mark { position, colour }
}
