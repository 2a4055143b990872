//! Architecture as rooms carved out of a solid: the walls are closed, face inward, and share every edge.
//!
//! The planes of all boxes divide space into the cells of a rectilinear grid. A cell is solid by default, air inside a
//! room, and solid again inside a block. There is a face wherever an air cell borders a solid cell. So
//! neighbouring faces always share whole edges.

use std::collections::BTreeMap;

use glam::Vec3;

use super::shape::{Shape, Side, polygon, side_corners};
use crate::base::ids::MaterialId;

/// Distance below which two coordinates are the same grid line, metres.
const SAME: f32 = 1e-4;

/// Materials of the six sides, in the order of [`Side::ALL`].
pub(super) type Finish = [MaterialId; 6];

/// Rooms and blocks; where boxes overlap, the later one determines the cell.
#[derive(Default)]
pub(super) struct Carving {
    boxes: Vec<Region>,
    windows: Vec<Aabb>,
}

type Aabb = (Vec3, Vec3);

struct Region {
    name: String,
    extent: Aabb,
    is_air: bool,
    /// Materials of the walls of a room or of the outside of a block.
    finish: Finish,
}

/// Grid lines along each axis, ascending.
type Lines = [Vec<f32>; 3];

impl Carving {
    /// Adds a room with the materials of its six walls.
    pub(super) fn room(&mut self, name: &str, extent: ([f32; 3], [f32; 3]), finish: Finish) {
        self.add(name, extent, true, finish);
    }

    /// Adds a solid block; `top` is the material of its upper side.
    pub(super) fn block(&mut self, name: &str, extent: ([f32; 3], [f32; 3]), sides: MaterialId, top: MaterialId) {
        let mut finish = [sides; 6];
        finish[Side::Above as usize] = top;
        self.add(name, extent, false, finish);
    }

    /// Adds a hole: faces inside the box are left out.
    pub(super) fn window(&mut self, extent: ([f32; 3], [f32; 3])) {
        self.windows.push((extent.0.into(), extent.1.into()));
    }

    fn add(&mut self, name: &str, (low, high): ([f32; 3], [f32; 3]), is_air: bool, finish: Finish) {
        self.boxes.push(Region { name: name.to_owned(), extent: (low.into(), high.into()), is_air, finish });
    }

    /// Returns the resulting surfaces, one for each side of each room and block: name, material, shape.
    pub(super) fn surfaces(&self) -> Vec<(String, MaterialId, Shape)> {
        let mut shapes: BTreeMap<(usize, usize), Vec<Shape>> = BTreeMap::new();
        for (region, side, face) in self.faces() {
            shapes.entry((region, side as usize)).or_default().push(face);
        }
        let surface = |((region, side), faces): ((usize, usize), Vec<Shape>)| {
            let region = &self.boxes[region];
            let name = format!("{} {}", region.name, side_name(region.is_air, Side::ALL[side]));
            (name, region.finish[side], faces.into_iter().collect())
        };
        shapes.into_iter().map(surface).collect()
    }

    /// Returns all faces between air and solid, each with its region and the side of that region.
    fn faces(&self) -> Vec<(usize, Side, Shape)> {
        let lines = self.lines();
        let owner = |cell: [usize; 3]| self.owner(&lines, cell);
        let mut faces = Vec::new();
        for (air, cell) in cells(&lines).filter_map(|cell| Some((owner(cell)?, cell))) {
            if !self.boxes[air].is_air {
                continue;
            }
            for side in Side::ALL {
                let beyond = neighbour(cell, side, &lines).and_then(owner);
                let (low, high) = bounds(&lines, cell);
                let corners = side_corners(low, high, side);
                if beyond.is_some_and(|beyond| self.boxes[beyond].is_air) || self.is_window(corners) {
                    continue;
                }
                // A face of a block belongs to the side of the block, which is opposite to the side of the air cell.
                let (region, own_side) = beyond.map_or((air, side), |block| (block, Side::ALL[side as usize ^ 1]));
                faces.push((region, own_side, polygon(&corners).inside_out()));
            }
        }
        faces
    }

    /// Returns the last region that contains the cell; `None` outside all regions, where space is solid.
    fn owner(&self, lines: &Lines, cell: [usize; 3]) -> Option<usize> {
        let (low, high) = bounds(lines, cell);
        let middle = (low + high) / 2.0;
        self.boxes.iter().rposition(|region| holds(region.extent, middle))
    }

    fn is_window(&self, corners: [Vec3; 4]) -> bool {
        let middle = corners.iter().sum::<Vec3>() / 4.0;
        self.windows.iter().any(|&window| holds(window, middle))
    }

    fn lines(&self) -> Lines {
        let extents = self.boxes.iter().map(|region| region.extent).chain(self.windows.iter().copied());
        let corners: Vec<Vec3> = extents.flat_map(|(low, high)| [low, high]).collect();
        [0, 1, 2].map(|axis| {
            let mut line: Vec<f32> = corners.iter().map(|corner| corner[axis]).collect();
            line.sort_by(f32::total_cmp);
            line.dedup_by(|next, kept| *next - *kept < SAME);
            line
        })
    }
}

fn cells(lines: &Lines) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = [0, 1, 2].map(|axis| lines[axis].len() - 1);
    (0..nx).flat_map(move |x| (0..ny).flat_map(move |y| (0..nz).map(move |z| [x, y, z])))
}

fn neighbour(mut cell: [usize; 3], side: Side, lines: &Lines) -> Option<[usize; 3]> {
    let (axis, is_positive) = side.axis();
    let index = if is_positive { cell[axis] + 1 } else { cell[axis].checked_sub(1)? };
    cell[axis] = index;
    (index + 1 < lines[axis].len()).then_some(cell)
}

fn bounds(lines: &Lines, cell: [usize; 3]) -> Aabb {
    let corner = |step: usize| Vec3::from([0, 1, 2].map(|axis| lines[axis][cell[axis] + step]));
    (corner(0), corner(1))
}

fn holds((low, high): Aabb, point: Vec3) -> bool {
    (point + SAME).cmpge(low).all() && (point - SAME).cmple(high).all()
}

fn side_name(is_air: bool, side: Side) -> &'static str {
    match (is_air, side) {
        (true, Side::West) => "west wall",
        (true, Side::East) => "east wall",
        (true, Side::North) => "north wall",
        (true, Side::South) => "south wall",
        (true, Side::Below) => "floor",
        (true, Side::Above) => "ceiling",
        (false, Side::West) => "west side",
        (false, Side::East) => "east side",
        (false, Side::North) => "north side",
        (false, Side::South) => "south side",
        (false, Side::Below) => "underside",
        (false, Side::Above) => "top",
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::super::builder::Builder;
    use super::*;
    use crate::base::ids::TriangleId;

    const UNIT: ([f32; 3], [f32; 3]) = ([0.0; 3], [1.0; 3]);

    fn built(carving: &Carving) -> crate::scene::Scene {
        let mut builder = Builder::new("test");
        for (name, material, shape) in carving.surfaces() {
            builder.place(&name, material, shape);
        }
        builder.finish()
    }

    /// Returns the number of edges without a partner in the opposite direction: zero for a closed surface without
    /// T-junctions.
    fn open_edges(scene: &crate::scene::Scene) -> usize {
        let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
        for t in 0..scene.triangles.len() {
            let corners = scene.corners(TriangleId::new(t)).map(|p| p.to_array().map(f32::to_bits));
            for i in 0..3 {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                *edges.entry(if a < b { [a, b] } else { [b, a] }).or_default() += if a < b { 1 } else { -1 };
            }
        }
        edges.values().filter(|&&count| count != 0).count()
    }

    #[test]
    fn a_room_with_a_block_and_a_side_room_is_closed_and_shares_all_edges() {
        let mut carving = Carving::default();
        let finish = [MaterialId(0); 6];
        carving.room("room", UNIT, finish);
        carving.room("niche", ([1.0, 0.25, 0.25], [1.5, 0.75, 0.75]), finish);
        carving.block("block", ([0.4, 0.0, 0.3], [0.6, 0.1, 0.9]), MaterialId(0), MaterialId(0));
        let scene = built(&carving);
        assert_eq!(open_edges(&scene), 0);
        // The niche and the block add four sides each; their ends replace the areas that they cover.
        let sides = 4.0 * 0.5 * 0.5 + 2.0 * 0.1 * (0.2 + 0.6);
        assert!((scene.area() - (6.0 + sides)).abs() < 1e-5, "{}", scene.area());
    }

    #[test]
    fn a_window_leaves_a_hole_of_its_size() {
        let mut carving = Carving::default();
        carving.room("room", UNIT, [MaterialId(0); 6]);
        carving.window(([0.2, 0.2, 1.0], [0.7, 0.6, 1.0]));
        let scene = built(&carving);
        assert!((scene.area() - (6.0 - 0.5 * 0.4)).abs() < 1e-5);
        assert_eq!(open_edges(&scene), 4);
    }

    #[test]
    fn walls_face_the_room() {
        let mut carving = Carving::default();
        carving.room("room", UNIT, [MaterialId(0); 6]);
        let scene = built(&carving);
        for t in 0..scene.triangles.len() {
            let corners = scene.corners(TriangleId::new(t));
            assert!(crate::scene::normal_of(corners).dot(Vec3::splat(0.5) - corners[0]) > 0.0);
        }
    }
}
