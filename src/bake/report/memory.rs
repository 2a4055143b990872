//! The memory that a bake used.

use serde::Serialize;

/// Memory, bytes.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Memory {
    /// Memory predicted before the bake.
    pub predicted: u64,
    /// Peak memory of the process until the end of the bake; `None` (null) if the system does not report it.
    pub peak: Option<u64>,
}

/// Returns the peak memory of the process so far, bytes, or `None` if the system does not report it.
pub(in crate::bake) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes * 1024)
}
