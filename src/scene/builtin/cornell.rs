//! The Cornell box, with its measured coordinates.
//!
//! Source: Cornell University Program of Computer Graphics, "The Cornell Box: Data" (1998). The reflectances and the
//! light are the linear Rec. 709 values that are commonly used for its spectra.

use glam::Vec3;

use super::builder::{Builder, paint};
use super::shape::{Shape, polygon};
use crate::scene::Scene;

const LIGHT: [[f32; 3]; 4] =
    [[343.0, 548.8, 227.0], [343.0, 548.8, 332.0], [213.0, 548.8, 332.0], [213.0, 548.8, 227.0]];
const FLOOR: [[f32; 3]; 4] = [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]];
const CEILING: [[f32; 3]; 4] = [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]];
const BACK_WALL: [[f32; 3]; 4] = [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]];
const RIGHT_WALL: [[f32; 3]; 4] = [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]];
const LEFT_WALL: [[f32; 3]; 4] = [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]];
const SHORT_BLOCK_TOP: [[f32; 3]; 4] =
    [[130.0, 165.0, 65.0], [82.0, 165.0, 225.0], [240.0, 165.0, 272.0], [290.0, 165.0, 114.0]];
const TALL_BLOCK_TOP: [[f32; 3]; 4] =
    [[423.0, 330.0, 247.0], [265.0, 330.0, 296.0], [314.0, 330.0, 456.0], [472.0, 330.0, 406.0]];

/// Returns the Cornell box: 5.5 m wide, the light flush in a hole of the ceiling, one camera.
#[must_use]
pub fn cornell() -> Scene {
    let mut builder = Builder::new("cornell");
    let white = builder.material(paint("white", [0.725, 0.71, 0.68]));
    let red = builder.material(paint("red", [0.63, 0.065, 0.05]));
    let green = builder.material(paint("green", [0.14, 0.45, 0.091]));
    let light = builder.glowing(paint("light", [0.78; 3]), Vec3::new(17.0, 12.0, 4.0), "light");
    builder.place("floor", white, polygon(&metres(FLOOR)));
    builder.place("ceiling", white, frame(metres(CEILING), metres(LIGHT)));
    builder.place("light", light, polygon(&metres(LIGHT)));
    builder.place("back wall", white, polygon(&metres(BACK_WALL)));
    builder.place("right wall", green, polygon(&metres(RIGHT_WALL)));
    // The measured corners of the left wall are not coplanar, so it is two triangles with a normal each.
    let [a, b, c, d] = metres(LEFT_WALL);
    builder.place("left wall", red, polygon(&[a, b, c]).join(polygon(&[a, c, d])));
    builder.place("short block", white, block(metres(SHORT_BLOCK_TOP)));
    builder.place("tall block", white, block(metres(TALL_BLOCK_TOP)));
    // Focal length 35 mm, film 25 mm square.
    builder.camera("camera", [2.78, 2.73, -8.0], [2.78, 2.73, 0.0], 2.0 * (12.5f32 / 35.0).atan().to_degrees());
    builder.finish()
}

fn metres(corners: [[f32; 3]; 4]) -> [Vec3; 4] {
    corners.map(|corner| Vec3::from(corner) / 100.0)
}

/// Returns the area between two quadrilaterals whose corners correspond.
fn frame(outer: [Vec3; 4], inner: [Vec3; 4]) -> Shape {
    (0..4)
        .map(|i| {
            let next = (i + 1) % 4;
            polygon(&[outer[i], outer[next], inner[next], inner[i]])
        })
        .collect()
}

/// Returns a block that stands on the floor, given its top, without a bottom face.
fn block(top: [Vec3; 4]) -> Shape {
    let on_floor = |corner: Vec3| corner.with_y(0.0);
    let side = |i: usize| {
        let (this, next) = (top[i], top[(i + 1) % 4]);
        polygon(&[on_floor(this), on_floor(next), next, this])
    };
    (0..4).map(side).collect::<Shape>().join(polygon(&top))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::TriangleId;
    use crate::scene::{area_of, normal_of};

    #[test]
    fn walls_face_inward_and_blocks_outward() {
        let scene = cornell();
        let middle = Vec3::new(2.78, 2.73, 2.8);
        for instance in &scene.instances {
            let triangles = instance.triangles.clone().map(TriangleId::new);
            let corners: Vec<[Vec3; 3]> = triangles.map(|id| scene.corners(id)).collect();
            let centre = corners.iter().flatten().sum::<Vec3>() / (3 * corners.len()) as f32;
            let is_block = instance.name.ends_with("block");
            for corners in corners {
                let inward = if is_block { corners[0] - centre } else { middle - corners[0] };
                assert!(normal_of(corners).dot(inward) > 0.0, "{}", instance.name);
            }
        }
    }

    #[test]
    fn the_light_fills_the_hole_in_the_ceiling() {
        let scene = cornell();
        let area = |name: &str| -> f32 {
            let instance = scene.instances.iter().find(|instance| instance.name == name).expect("is there");
            instance.triangles.clone().map(|t| area_of(scene.corners(TriangleId::new(t)))).sum()
        };
        assert!((area("light") - 1.3 * 1.05).abs() < 1e-4);
        assert!((area("ceiling") + area("light") - 5.56 * 5.592).abs() < 1e-3);
    }
}
