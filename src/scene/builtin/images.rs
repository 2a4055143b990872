//! Procedural textures: a plank floor and four paintings, encoded as PNG.
//!
//! They use only exactly rounded arithmetic and hashes, so that every machine generates the same bytes.

use std::io::Cursor;

use glam::{Vec2, Vec3};

use crate::base::sampling::{hash, unit_float};
use crate::scene::Image;

/// Returns an image whose pixel at (u, v), both in 0..1 from the top left, has the sRGB colour `paint((u, v))`.
fn image(name: &str, [width, height]: [u32; 2], paint: impl Fn(Vec2) -> Vec3) -> Image {
    let pixels = image::RgbImage::from_fn(width, height, |x, y| {
        let at = (Vec2::new(x as f32, y as f32) + 0.5) / Vec2::new(width as f32, height as f32);
        let colour = (paint(at).clamp(Vec3::ZERO, Vec3::ONE) * 255.0).round();
        image::Rgb(colour.to_array().map(|channel| channel as u8))
    });
    let mut encoded = Cursor::new(Vec::new());
    pixels.write_to(&mut encoded, image::ImageFormat::Png).expect("a PNG in memory can always be written");
    let rgba = pixels.pixels().flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255]).collect();
    Image { name: name.to_owned(), width, height, rgba, encoded: encoded.into_inner(), mime_type: "image/png".into() }
}

fn rgb(hex: u32) -> Vec3 {
    Vec3::from([hex >> 16, hex >> 8 & 0xff, hex & 0xff].map(|channel| channel as f32 / 255.0))
}

/// Uniform pseudo-random number in 0..1, a function of a pair of integers.
fn random(x: i32, y: i32) -> f32 {
    unit_float(hash((x as u32).wrapping_mul(0x9e37_79b9) ^ hash(y as u32)))
}

/// Returns the value noise in 0..1 that repeats after `period` cells.
fn noise(at: Vec2, period: [i32; 2]) -> f32 {
    let low = at.floor();
    let share = at - low;
    let share = share * share * (3.0 - 2.0 * share);
    let cell =
        |dx: i32, dy: i32| random((low.x as i32 + dx).rem_euclid(period[0]), (low.y as i32 + dy).rem_euclid(period[1]));
    let top = cell(0, 0) + (cell(1, 0) - cell(0, 0)) * share.x;
    let bottom = cell(0, 1) + (cell(1, 1) - cell(0, 1)) * share.x;
    top + (bottom - top) * share.y
}

/// Paints eight planks side by side with staggered ends and grain along V; the image tiles.
pub(super) fn planks() -> Image {
    const PLANKS: f32 = 8.0;
    image("planks", [256, 256], |at| {
        let plank = (at.x * PLANKS).floor();
        let end = random(plank as i32, 1);
        let is_second = f32::from(at.y > end);
        let tone = random(plank as i32, 2 + is_second as i32);
        let grain =
            noise(at * Vec2::new(64.0, 6.0), [64, 6]) * 0.6 + noise(at * Vec2::new(160.0, 16.0), [160, 16]) * 0.4;
        let across = (at.x * PLANKS - plank).min(plank + 1.0 - at.x * PLANKS);
        let seam = if across < 0.03 || (at.y - end).abs() < 0.003 { 0.72 } else { 1.0 };
        rgb(0xb8_93_6a).lerp(rgb(0xa2_7a_52), tone) * (0.90 + 0.16 * grain) * seam
    })
}

/// Paints rectangles of primary colours between black bars.
pub(super) fn composition() -> Image {
    const COLUMNS: [f32; 3] = [0.22, 0.68, 0.86];
    const ROWS: [f32; 3] = [0.30, 0.62, 0.85];
    image("composition", [128, 128], |at| {
        let is_bar = |x: f32, bars: [f32; 3]| bars.iter().any(|bar| (x - bar).abs() < 0.014);
        if is_bar(at.x, COLUMNS) || is_bar(at.y, ROWS) {
            return rgb(0x18_18_1a);
        }
        let cell = |x: f32, bars: [f32; 3]| bars.iter().filter(|&&bar| bar < x).count();
        match (cell(at.x, COLUMNS), cell(at.y, ROWS)) {
            (1, 0) => rgb(0xc8_2a_1e),
            (0, 2) | (3, 3) => rgb(0xe8_b9_21),
            (2, 2) | (0, 0) => rgb(0x1f_4e_9c),
            (2, 1) => rgb(0xcf_c8_b8),
            _ => rgb(0xee_ea_df),
        }
    })
}

/// Paints rings round two centres.
pub(super) fn rings() -> Image {
    const PALETTE: [u32; 5] = [0x12_33_4a, 0xe2_7d_2c, 0xf3_e0_b5, 0x2b_7f_82, 0xa6_2b_34];
    image("rings", [128, 128], |at| {
        let distance = |x: f32, y: f32| (at - Vec2::new(x, y)).length();
        let (near, far) = (distance(0.36, 0.42), distance(0.78, 0.70));
        let ring = if far < 0.21 { (far * 24.0) as usize + 2 } else { (near * 13.0) as usize };
        rgb(PALETTE[ring % PALETTE.len()])
    })
}

/// Paints two soft fields of colour one above the other.
pub(super) fn fields() -> Image {
    image("fields", [64, 128], |at| {
        // Coverage by a rectangle with blurred borders: 0 outside, 1 well inside.
        let inside = |low: Vec2, high: Vec2| {
            let depth = (at - low).min(high - at).min_element() + 0.04 * (noise(at * 24.0, [24, 24]) - 0.5);
            let share = (depth / 0.06).clamp(0.0, 1.0);
            share * share * (3.0 - 2.0 * share)
        };
        let upper = inside(Vec2::new(0.08, 0.06), Vec2::new(0.92, 0.52));
        let lower = inside(Vec2::new(0.08, 0.57), Vec2::new(0.92, 0.94));
        rgb(0x7a_24_1f).lerp(rgb(0xe8_8a_1f), upper).lerp(rgb(0x3a_12_2e), lower)
    })
}

/// Paints blue hills before a pale sky.
pub(super) fn hills() -> Image {
    image("hills", [128, 128], |at| {
        let sky = rgb(0xf4_e3_c3).lerp(rgb(0x9d_c3_d6), 1.0 - at.y);
        let sun = (at * Vec2::new(1.6, 1.0) - Vec2::new(1.15, 0.30)).length();
        let sky = if sun < 0.09 { rgb(0xff_f4_dc) } else { sky };
        (0..4).fold(sky, |colour, ridge| {
            let depth = ridge as f32;
            let height = 0.42 + 0.13 * depth + 0.16 * (noise(Vec2::new(at.x * (3.0 + depth), depth), [16, 16]) - 0.5);
            if at.y > height { rgb(0x8f_b2_bf).lerp(rgb(0x17_3a_48), depth / 3.0) } else { colour }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoded_bytes_decode_to_the_pixels() {
        let image = planks();
        let decoded = image::load_from_memory(&image.encoded).expect("a PNG").to_rgba8();
        assert_eq!(decoded.into_raw(), image.rgba);
    }

    #[test]
    fn noise_tiles() {
        for i in 0..20 {
            let y = i as f32 * 0.37;
            assert!((noise(Vec2::new(0.0, y), [8, 8]) - noise(Vec2::new(8.0, y), [8, 8])).abs() < 1e-6);
        }
    }
}
