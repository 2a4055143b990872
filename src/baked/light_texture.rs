//! Light as a texture over the original scene, for programs that do not read light at vertices.

use std::io::Cursor;

use glam::{Vec2, Vec3};

use crate::scene::Scene;

/// A scene whose light is stored in one texture (a lightmap).
#[derive(Clone, Debug, Default)]
pub struct Lightmap {
    /// The scene, not cut into elements. Backs of double-sided triangles are separate triangles, as in a bake. Vertices
    /// are separate at seams of the texture.
    pub scene: Scene,
    /// Texture coordinates `[v]`, 0 to 1 from the top left corner.
    pub coordinates: Vec<Vec2>,
    /// The texture.
    pub texels: Texels,
    /// Width of a texel on the surfaces, metres.
    pub texel_size: f32,
    /// Mean deviation in luminance from the light at vertices, relative to the mean luminance.
    pub deviation: f32,
}

/// A texture of irradiance, in rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texels {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Irradiance `[y][x]`, lux per channel, the sum of direct and indirect light of all groups.
    pub irradiance: Vec<Vec3>,
}

impl Texels {
    /// Returns the bytes of an OpenEXR file: lux per channel in 32-bit floats.
    #[must_use]
    pub fn to_exr(&self) -> Vec<u8> {
        let channels = bytemuck::cast_slice(&self.irradiance).to_vec();
        let picture = image::Rgb32FImage::from_raw(self.width, self.height, channels).expect("three floats a texel");
        let mut file = Cursor::new(Vec::new());
        picture.write_to(&mut file, image::ImageFormat::OpenExr).expect("writing to memory succeeds");
        file.into_inner()
    }

    /// Samples the texture bilinearly, as a graphics card does.
    #[must_use]
    pub fn sample(&self, coordinate: Vec2) -> Vec3 {
        let at = coordinate * Vec2::new(self.width as f32, self.height as f32) - 0.5;
        let low = at.floor();
        let share = at - low;
        let texel = |x: f32, y: f32| {
            let inside = |value: f32, size: u32| (value.max(0.0) as usize).min(size as usize - 1);
            self.irradiance[inside(low.y + y, self.height) * self.width as usize + inside(low.x + x, self.width)]
        };
        let top = texel(0.0, 0.0).lerp(texel(1.0, 0.0), share.x);
        let bottom = texel(0.0, 1.0).lerp(texel(1.0, 1.0), share.x);
        top.lerp(bottom, share.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_are_interpolated_linearly_and_written_as_floats() {
        let irradiance = [0.0, 1.0, 10.0, 11.0].map(Vec3::splat).to_vec();
        let texels = Texels { width: 2, height: 2, irradiance };
        let at = |x, y| texels.sample(Vec2::new(x, y)).x;
        assert_eq!([at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75), at(0.75, 0.75)], [0.0, 1.0, 10.0, 11.0]);
        let exr = image::load_from_memory(&texels.to_exr()).expect("an EXR file").into_rgb32f();
        assert_eq!((exr.dimensions(), exr.get_pixel(1, 1).0), ((2, 2), [11.0; 3]));
        assert_eq!([at(0.5, 0.5), at(0.5, 0.0), at(1.0, 1.0), at(0.0, 0.5)], [5.5, 0.5, 11.0, 5.0]);
    }
}
