//! Rows of patches, kept within a budget of memory.

use crate::base::ids::PatchId;
use crate::base::progress::Progress;
use crate::form_factor::{Entry, FormFactorError, FormFactorSource, MAX_BACK_SHARE, Viewpoint, map_rows};
use crate::patch::PatchMesh;
use crate::radiosity::viewpoints::Viewpoints;

/// The row of a patch: one entry per element in view, sorted by element.
#[derive(Clone, Debug, Default)]
pub struct PatchRow {
    /// Form factors.
    pub entries: Vec<Entry>,
    /// Share of the view that ends on black backs.
    pub back: f32,
    /// Share of the view without a surface.
    pub sky: f32,
}

/// Computes rows on demand and keeps them within a budget: a patch that shoots again needs no new hemicubes.
#[derive(Debug)]
pub struct RowStore {
    rows: Vec<Option<PatchRow>>,
    bytes: usize,
    budget: usize,
    points_a_patch: usize,
    num_computed: usize,
}

impl RowStore {
    /// Creates an empty store. Each row is the mean over `points_a_patch` viewpoints.
    #[must_use]
    pub fn new(num_patches: usize, points_a_patch: usize, budget: usize) -> Self {
        Self { rows: vec![None; num_patches], bytes: 0, budget, points_a_patch, num_computed: 0 }
    }

    /// Returns the row of a patch, or `None` if it is not stored.
    #[must_use]
    pub fn get(&self, patch: PatchId) -> Option<&PatchRow> {
        self.rows[patch.index()].as_ref()
    }

    /// Number of viewpoints whose rows have been computed.
    #[must_use]
    pub fn num_viewpoints(&self) -> usize {
        self.num_computed * self.points_a_patch
    }

    /// Computes the missing rows of `patches`; returns false if cancelled before all are there.
    ///
    /// # Errors
    /// Returns an error if the form factors cannot be computed.
    pub fn compute(
        &mut self,
        patches: &[PatchId],
        mesh: &PatchMesh,
        viewpoints: &Viewpoints,
        source: &mut dyn FormFactorSource,
        progress: &dyn Progress,
    ) -> Result<bool, FormFactorError> {
        let missing: Vec<PatchId> = patches.iter().copied().filter(|&p| self.get(p).is_none()).collect();
        let of_patch = |p: &PatchId| viewpoints.on_patch(mesh, &mesh.patches[p.index()], self.points_a_patch);
        let points: Vec<Viewpoint> = missing.iter().flat_map(of_patch).collect();
        let may_continue = || {
            progress.rest();
            !progress.is_cancelled()
        };
        let found = map_rows(source, &points, &may_continue, |_, row| PatchRow {
            entries: merged(&row.entries),
            back: row.back(),
            sky: row.sky,
        })?;
        for (patch, rows) in missing.iter().zip(found.chunks_exact(self.points_a_patch)) {
            let row = mean_row(rows);
            self.bytes += size_of_val(row.entries.as_slice());
            self.rows[patch.index()] = Some(row);
            self.num_computed += 1;
        }
        Ok(found.len() == points.len())
    }

    /// Drops rows of `patches`, the last first, until all rows fit into the budget.
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

/// Returns one entry per element, sorted by element id.
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

/// Returns the mean of the rows of one patch's viewpoints. Viewpoints inside a solid are left out if there are others,
/// because they exchange no light and would darken the open part of the patch.
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
