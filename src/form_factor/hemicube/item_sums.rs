//! Sums delta form factors over the items of one hemicube into its row of form factors.

use crate::base::ids::ElementId;
use crate::form_factor::{Entry, Row};

/// Item of a pixel without an element in view.
const NOTHING: u32 = 0;
/// Item of element 0.
const FIRST_ELEMENT: u32 = 1;
/// Flag of an item: the pixel sees the black back of a single-sided surface whose front is the element.
const BLACK_BACK: u32 = 1 << 31;

/// Returns the element that a pixel shows, or `None` if it shows nothing or a black back.
pub(super) fn element_of(item: u32) -> Option<u32> {
    (item & BLACK_BACK == 0).then(|| item.checked_sub(FIRST_ELEMENT)).flatten()
}

/// Sums the delta form factors of each run of equal items.
///
/// `items` yields the pixel rows of the atlas cell, `deltas` has the same layout. Runs keep their order, so the sum is
/// the same on every machine; an element seen in several runs gets several entries.
pub(super) fn sum_items<'a>(items: impl Iterator<Item = &'a [u32]>, deltas: &[f32], width: usize, row: &mut Row) {
    row.clear();
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
    let entry = |item: u32| Entry { element: ElementId(item - FIRST_ELEMENT), factor };
    match item {
        NOTHING => row.sky += factor,
        _ if item & BLACK_BACK == 0 => row.entries.push(entry(item)),
        _ => row.backs.push(entry(item & !BLACK_BACK)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_equal_items_are_summed_and_the_row_is_complete() {
        let items = [[1, 1, 0, BLACK_BACK | 3], [2, 2, 2, 1]];
        let deltas = [0.125; 8];
        let mut row = Row::default();
        sum_items(items.iter().map(|line| line.as_slice()), &deltas, 4, &mut row);
        let entry = |element, factor| Entry { element: ElementId(element), factor };
        assert_eq!(row.entries, [entry(0, 0.25), entry(1, 0.375), entry(0, 0.125)]);
        assert_eq!((row.sky, row.backs), (0.125, vec![entry(2, 0.125)]));
    }
}
