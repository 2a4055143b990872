//! From the items of one hemicube to its row of form factors.

use crate::base::ids::ElementId;
use crate::form_factor::{Entry, Row};

/// Item of a pixel that sees nothing.
pub(super) const NOTHING: u32 = 0;
/// Item of a pixel that sees the back of a single-sided surface.
pub(super) const BACK: u32 = 1;
/// Item of element 0.
pub(super) const FIRST_ELEMENT: u32 = 2;

/// Sums the delta form factors of each run of equal items.
///
/// `items` yields the rows of pixels of the atlas cell, `deltas` is laid out alike. Runs keep their order, so the sum is
/// the same on every machine; an element seen in several runs gets several entries.
pub(super) fn sum_items<'a>(items: impl Iterator<Item = &'a [u32]>, deltas: &[f32], width: usize, row: &mut Row) {
    row.entries.clear();
    row.back = 0.0;
    row.sky = 0.0;
    for (line, weights) in items.zip(deltas.chunks_exact(width)) {
        let mut item = line[0];
        let mut factor = 0.0;
        for (&next, &delta) in line.iter().zip(weights) {
            if next != item {
                add(row, item, factor);
                item = next;
                factor = 0.0;
            }
            factor += delta;
        }
        add(row, item, factor);
    }
}

fn add(row: &mut Row, item: u32, factor: f32) {
    match item {
        NOTHING => row.sky += factor,
        BACK => row.back += factor,
        _ => row.entries.push(Entry { element: ElementId(item - FIRST_ELEMENT), factor }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_summed_and_the_row_is_complete() {
        let items = [[2, 2, 0, 1], [3, 3, 3, 2]];
        let deltas = [0.125; 8];
        let mut row = Row::default();
        sum_items(items.iter().map(|line| line.as_slice()), &deltas, 4, &mut row);
        let entry = |element, factor| Entry { element: ElementId(element), factor };
        assert_eq!(row.entries, [entry(0, 0.25), entry(1, 0.375), entry(0, 0.125)]);
        assert_eq!((row.sky, row.back), (0.125, 0.125));
    }
}
