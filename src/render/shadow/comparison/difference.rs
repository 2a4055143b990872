//! The difference of two techniques: in how many pixels they decide differently whether a light is visible.
//!
//! Techniques may place the edge of a shadow up to a pixel apart, which is no fault. So only decisions more than one
//! pixel away from an edge of the reference's shadow are compared.

use glam::Vec3;

use super::decisions::{Decisions, SampleDecisions};

/// The difference between a technique and a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowDifference {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Share of the pixels in which the decision about at least one light sample differs.
    pub share: f32,
    /// Number of light samples about which the techniques differ, `[pixel]`.
    pub count: Vec<u32>,
    /// True if the light is visible here and hidden in the reference, `[pixel]`; meaningful only where `count` is not
    /// zero.
    pub is_too_bright: Vec<bool>,
}

impl Decisions {
    /// Returns true for each pixel with a neighbour whose decision differs.
    fn edges(&self, lit: &[bool]) -> Vec<bool> {
        let [width, height] = self.size.map(|side| side as usize);
        let is_edge = |at: usize| {
            let (x, y) = (at % width, at / width);
            let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
            let mut rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            rows.any(|row| columns.clone().any(|column| lit[row * width + column] != lit[at]))
        };
        (0..lit.len()).map(is_edge).collect()
    }
}

impl SampleDecisions {
    fn claims(&self, pixel: usize) -> bool {
        self.claimed.as_ref().is_none_or(|claimed| claimed[pixel])
    }
}

/// Compares `decisions` with those of a `reference`.
#[must_use]
pub fn shadow_difference(decisions: &Decisions, reference: &Decisions) -> ShadowDifference {
    let num_pixels = (reference.size[0] * reference.size[1]) as usize;
    let (mut count, mut is_too_bright) = (vec![0; num_pixels], vec![false; num_pixels]);
    for (ours, theirs) in decisions.samples.iter().zip(&reference.samples) {
        let edges = reference.edges(&theirs.lit);
        let differs =
            |&pixel: &usize| ours.lit[pixel] != theirs.lit[pixel] && ours.claims(pixel) && theirs.claims(pixel);
        for pixel in (0..num_pixels).filter(differs).filter(|&pixel| !edges[pixel]) {
            count[pixel] += 1;
            is_too_bright[pixel] = ours.lit[pixel];
        }
    }
    let share = count.iter().filter(|&&count| count > 0).count() as f32 / num_pixels.max(1) as f32;
    ShadowDifference { size: reference.size, share, count, is_too_bright }
}

impl ShadowDifference {
    /// Draws the difference over the shadows of the reference. Grey is the share of visible lights; red marks too much
    /// light, blue too little.
    #[must_use]
    pub fn picture(&self, reference: &Decisions) -> Vec<Vec3> {
        let num_samples = reference.samples.len().max(1) as f32;
        let colour = |pixel: usize| match (self.count[pixel] > 0, self.is_too_bright[pixel]) {
            (true, true) => Vec3::new(1.0, 0.1, 0.0),
            (true, false) => Vec3::new(0.0, 0.3, 1.0),
            (false, _) => {
                let visible = reference.samples.iter().filter(|sample| sample.lit[pixel]).count() as f32;
                Vec3::splat(0.02 + 0.4 * visible / num_samples)
            }
        };
        (0..self.count.len()).map(colour).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decisions about one light, 8 x 8 pixels.
    fn decisions(lit: impl Fn(usize, usize) -> bool) -> Decisions {
        let lit = (0..64).map(|i| lit(i % 8, i / 8)).collect();
        Decisions { size: [8, 8], samples: vec![SampleDecisions { lit, claimed: None }] }
    }

    #[test]
    fn an_edge_may_move_by_a_pixel_and_no_further() {
        let edge_at = |edge: usize| decisions(move |x, _| x < edge);
        let share = |a, b| shadow_difference(&edge_at(a), &edge_at(b)).share;
        assert_eq!(share(4, 4), 0.0);
        assert_eq!(share(5, 4), 0.0);
        assert_eq!(share(6, 4), 1.0 / 8.0);
    }

    #[test]
    fn a_single_wrong_pixel_counts() {
        let all = decisions(|_, _| true);
        let hole = decisions(|x, y| (x, y) != (3, 5));
        let difference = shadow_difference(&hole, &all);
        assert_eq!(difference.share, 1.0 / 64.0);
        assert!(!difference.is_too_bright[5 * 8 + 3]);
    }
}
