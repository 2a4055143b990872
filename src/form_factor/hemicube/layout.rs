//! Places of the hemicubes of a submission in an atlas.

/// Width of an atlas, pixels; a multiple of every hemicube size and of the copy alignment.
pub(super) const ATLAS_WIDTH: u32 = 512;
/// Height of an atlas, pixels. An atlas has room for one hemicube of the largest size, or 64 of the usual one.
pub(super) const ATLAS_HEIGHT: u32 = 1536;

/// The grid of cells of hemicubes `n` pixels wide; a cell is n wide and 3 n high: the top face, then four half sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub n: u32,
}

impl Layout {
    pub(super) fn columns(self) -> u32 {
        ATLAS_WIDTH / self.n
    }

    /// Number of hemicubes per submission.
    pub(super) fn capacity(self) -> usize {
        (self.columns() * (ATLAS_HEIGHT / (3 * self.n))) as usize
    }

    /// Top left pixel of a cell.
    pub(super) fn origin(self, cell: usize) -> (u32, u32) {
        let cell = cell as u32;
        (cell % self.columns() * self.n, cell / self.columns() * 3 * self.n)
    }
}
