//! Architecture of the gallery: rooms, steps, dais, pedestals, columns.

use glam::Vec2;

use super::super::builder::Builder;
use super::super::carving::{Carving, Finish};
use super::super::round::lathe;
use super::super::shape::Side;
use super::finishes::{Finishes, with_planks};
use crate::base::ids::MaterialId;

/// Height of the ceiling of the hall above its floor, metres.
pub(super) const HALL_HEIGHT: f32 = 4.4;
/// Height of the ceiling of the red room above its floor, metres.
pub(super) const RED_ROOM_HEIGHT: f32 = 3.2;
/// Z coordinate of the wall with the windows, metres.
pub(super) const WINDOW_WALL_Z: f32 = 7.2;
/// X coordinates of the west and east edges of each window, metres.
pub(super) const WINDOWS_X: [[f32; 2]; 3] = [[0.9, 2.1], [2.7, 3.9], [4.5, 5.7]];
/// Y coordinates of the lower and upper edges of the windows, metres.
pub(super) const WINDOWS_Y: [f32; 2] = [2.4, 3.6];
/// Height of the dais and of the pedestals, metres.
pub(super) const DAIS_HEIGHT: f32 = 6.0 * RISER;
/// Names of the sculptures, and minimum (x, z) corners of their pedestals, metres.
pub(super) const PEDESTALS: [(&str, [f32; 2]); 3] =
    [("torus", [5.7, 0.9]), ("sphere", [-6.1, 0.9]), ("prism", [-3.4, 4.5])];
/// Width and depth of a pedestal, metres.
pub(super) const PEDESTAL: f32 = 0.6;

/// Height of the doorway, metres. It equals that of the window sills, so that both share a grid line.
const DOOR_HEIGHT: f32 = WINDOWS_Y[0];
const RISER: f32 = 0.17;
const TREAD: f32 = 0.3;
const STEPS_Z: [f32; 2] = [2.7, 4.5];
const DAIS_X: [f32; 2] = [8.1, 10.2];
const COLUMNS_X: [f32; 4] = [0.6, 2.4, 4.2, 6.0];
const COLUMNS_Z: f32 = 5.4;

/// Adds rooms, steps, dais and pedestals as one carving, a closed surface in which all edges are shared.
pub(super) fn build(builder: &mut Builder, finishes: &Finishes) {
    let mut carving = Carving::default();
    rooms(&mut carving, finishes);
    dais(&mut carving, finishes);
    for (name, [x, z]) in PEDESTALS {
        let extent = ([x, 0.0, z], [x + PEDESTAL, DAIS_HEIGHT, z + PEDESTAL]);
        carving.block(&format!("pedestal of the {name}"), extent, finishes.plaster, finishes.plaster);
    }
    for x in COLUMNS_X {
        let (low, high) = ([x - 0.3, 0.0, COLUMNS_Z - 0.3], [x + 0.3, RISER, COLUMNS_Z + 0.3]);
        carving.block("plinth", (low, high), finishes.stone, finishes.stone);
    }
    for [west, east] in WINDOWS_X {
        let [sill, head] = WINDOWS_Y;
        carving.window(([west, sill, WINDOW_WALL_Z], [east, head, WINDOW_WALL_Z]));
    }
    for (name, material, shape) in carving.surfaces() {
        let is_planked = material == finishes.oak || material == finishes.walnut;
        builder.place(&name, material, if is_planked { with_planks(shape) } else { shape });
    }
}

fn rooms(carving: &mut Carving, finishes: &Finishes) {
    let walls = |floor: MaterialId, west: MaterialId, east: MaterialId| -> Finish {
        [west, east, floor, finishes.ceiling, finishes.white, finishes.white]
    };
    let (white, panel) = (finishes.white, finishes.ceiling_panel);
    let hall = ([0.0; 3], [DAIS_X[1], HALL_HEIGHT, WINDOW_WALL_Z]);
    carving.room("hall", hall, walls(finishes.oak, white, finishes.blue_green));
    let red_room = ([-6.4, 0.0, 0.0], [-0.4, RED_ROOM_HEIGHT, 5.7]);
    carving.room("red room", red_room, walls(finishes.walnut, finishes.red, white));
    let doorway = ([-0.4, 0.0, STEPS_Z[0]], [0.0, DOOR_HEIGHT, STEPS_Z[1]]);
    carving.room("doorway", doorway, walls(finishes.walnut, white, white));
    // The luminous ceiling is 10 cm above the ceiling, in a recess.
    let mut recess = [white; 6];
    recess[Side::Above as usize] = panel;
    carving.room("ceiling panel", ([8.7, HALL_HEIGHT, 1.5], [9.6, HALL_HEIGHT + 0.1, 5.7]), recess);
}

fn dais(carving: &mut Carving, finishes: &Finishes) {
    let (plaster, oak) = (finishes.plaster, finishes.oak);
    let [west, east] = DAIS_X;
    carving.block("dais", ([west, 0.0, 0.0], [east, DAIS_HEIGHT, WINDOW_WALL_Z]), plaster, oak);
    for [north, south] in [[0.0, STEPS_Z[0]], [STEPS_Z[1], WINDOW_WALL_Z]] {
        let (low, high) = ([west, DAIS_HEIGHT, north], [west + 0.15, DAIS_HEIGHT + 0.9, south]);
        carving.block("parapet", (low, high), plaster, plaster);
    }
    // Five steps and the dais have six risers.
    for step in 1..6u8 {
        let (up, back) = (f32::from(step), f32::from(6 - step));
        let low = [west - back * TREAD, 0.0, STEPS_Z[0]];
        carving.block("step", (low, [west, up * RISER, STEPS_Z[1]]), finishes.stone, finishes.stone);
    }
}

/// Adds a row of columns between the windows and the hall, each on a plinth.
pub(super) fn columns(builder: &mut Builder, finishes: &Finishes) {
    // Base moulding, slightly tapering shaft, capital; (radius, height above the plinth).
    let top = HALL_HEIGHT - RISER;
    let profile =
        [(0.27, 0.0), (0.27, 0.07), (0.21, 0.13), (0.20, 1.5), (0.175, top - 0.22), (0.25, top - 0.10), (0.25, top)];
    for (x, number) in COLUMNS_X.into_iter().zip(1..) {
        let column = lathe(&profile.map(Vec2::from), 24).moved([x, RISER, COLUMNS_Z].into());
        builder.place(&format!("column {number}"), finishes.stone, column);
    }
}
