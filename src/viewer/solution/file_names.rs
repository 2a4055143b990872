//! Names of files that the viewer writes.

use std::path::{Path, PathBuf};

/// Returns the first of `STEM-001.ENDING`, `STEM-002.ENDING` ... that does not exist yet; `None` if all 999 exist.
#[must_use]
pub fn next_free_name(folder: &Path, stem: &str, ending: &str) -> Option<PathBuf> {
    (1..1000).map(|number| folder.join(format!("{stem}-{number:03}.{ending}"))).find(|path| !path.exists())
}
