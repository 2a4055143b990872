//! Rows of patches, kept as long as memory allows.

use super::sites::Sites;
use crate::base::ids::PatchId;
use crate::base::progress::Progress;
use crate::form_factor::{Entry, FormFactorError, FormFactorSource, MAX_BACK_SHARE, Viewpoint, map_rows};
use crate::patch::PatchMesh;

/// What a patch sees: one entry an element, sorted by element.
#[derive(Clone, Debug, Default)]
pub struct PatchRow {
    /// Form factors.
    pub entries: Vec<Entry>,
    /// Share that ends on black backs.
    pub back: f32,
    /// Share that leaves the scene.
    pub sky: f32,
}

/// Finds rows on the fly and keeps them within a budget: a patch that shoots again needs no new hemicubes.
#[derive(Debug)]
pub struct RowStore {
    rows: Vec<Option<PatchRow>>,
    bytes: usize,
    budget: usize,
    points_a_patch: usize,
    num_found: usize,
}

impl RowStore {
    /// An empty store; each row will be the mean over `points_a_patch` viewpoints.
    #[must_use]
    pub fn new(num_patches: usize, points_a_patch: usize, budget: usize) -> Self {
        Self { rows: vec![None; num_patches], bytes: 0, budget, points_a_patch, num_found: 0 }
    }

    /// Row of a patch, where it is kept.
    #[must_use]
    pub fn get(&self, patch: PatchId) -> Option<&PatchRow> {
        self.rows[patch.index()].as_ref()
    }

    /// Viewpoints whose rows were found so far.
    #[must_use]
    pub fn num_viewpoints(&self) -> usize {
        self.num_found * self.points_a_patch
    }

    /// Makes sure that every one of `patches` has its row; false where cancelled before.
    ///
    /// # Errors
    /// The form factors could not be found.
    pub fn find(
        &mut self,
        patches: &[PatchId],
        mesh: &PatchMesh,
        sites: &Sites,
        method: &mut dyn FormFactorSource,
        progress: &dyn Progress,
    ) -> Result<bool, FormFactorError> {
        let missing: Vec<PatchId> = patches.iter().copied().filter(|&p| self.get(p).is_none()).collect();
        let viewpoints: Vec<Viewpoint> =
            missing.iter().flat_map(|p| sites.of_patch(mesh, &mesh.patches[p.index()], self.points_a_patch)).collect();
        let go_on = || {
            progress.rest();
            !progress.is_cancelled()
        };
        let found = map_rows(method, &viewpoints, &go_on, |_, row| PatchRow {
            entries: merged(&row.entries),
            back: row.back(),
            sky: row.sky,
        })?;
        for (patch, rows) in missing.iter().zip(found.chunks_exact(self.points_a_patch)) {
            let row = mean_row(rows);
            self.bytes += size_of_val(row.entries.as_slice());
            self.rows[patch.index()] = Some(row);
            self.num_found += 1;
        }
        Ok(found.len() == viewpoints.len())
    }

    /// Drops rows of `patches`, last first, until the budget holds.
    pub fn keep_within_budget(&mut self, patches: &[PatchId]) {
        for patch in patches.iter().rev() {
            if self.bytes <= self.budget {
                break;
            }
            if let Some(row) = self.rows[patch.index()].take() {
                self.bytes -= size_of_val(row.entries.as_slice());
            }
        }
    }
}

/// One entry an element, by element id.
fn merged(entries: &[Entry]) -> Vec<Entry> {
    let mut sorted = entries.to_vec();
    sorted.sort_by_key(|entry| entry.element);
    sorted.dedup_by(|next, kept| {
        let is_same = next.element == kept.element;
        if is_same {
            kept.factor += next.factor;
        }
        is_same
    });
    sorted.shrink_to_fit();
    sorted
}

/// The mean of the rows of one patch's viewpoints. Those inside something are left out where there are others: no light
/// comes or goes there, and the part that is open shall not be darker for it.
fn mean_row(rows: &[PatchRow]) -> PatchRow {
    let is_open = |row: &&PatchRow| row.back <= MAX_BACK_SHARE;
    let num_open = rows.iter().filter(is_open).count();
    let counted: Vec<&PatchRow> =
        if num_open > 0 { rows.iter().filter(is_open).collect() } else { rows.iter().collect() };
    if let [row] = counted[..] {
        return row.clone();
    }
    let share = 1.0 / counted.len() as f32;
    let scaled = |entry: &Entry| Entry { factor: entry.factor * share, ..*entry };
    let all: Vec<Entry> = counted.iter().flat_map(|row| &row.entries).map(scaled).collect();
    PatchRow {
        entries: merged(&all),
        back: counted.iter().map(|row| row.back).sum::<f32>() * share,
        sky: counted.iter().map(|row| row.sky).sum::<f32>() * share,
    }
}
