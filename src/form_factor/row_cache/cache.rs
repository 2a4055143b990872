//! The file of rows. Only one process at a time can open it; rows are indexed in memory and appended to the file.

use std::collections::HashMap;
use std::fs::{File, TryLockError};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use thiserror::Error;

use super::record::{HEADER, RecordHead, read_row, write_record};
use crate::form_factor::Row;

/// A row cache cannot be opened.
#[derive(Debug, Error)]
pub enum RowCacheError {
    /// The file cannot be opened, read or created.
    #[error("{}: cannot be used as a row cache: {}", .0.display(), .1)]
    Io(PathBuf, io::Error),
    /// The file is not a row cache. It is left unchanged.
    #[error("{}: is not a row cache of Hemicube; name another file, or delete this one", .0.display())]
    NotOurs(PathBuf),
    /// Another process holds the lock of the file.
    #[error("{}: another bake is using this row cache", .0.display())]
    InUse(PathBuf),
}

/// Rows of form factors stored in a file.
#[derive(Debug)]
pub struct RowCache {
    path: PathBuf,
    rows: Mutex<Rows>,
}

#[derive(Debug)]
struct Rows {
    file: File,
    /// Offset of the record of each row, by fingerprint.
    offsets: HashMap<u128, u64>,
    end: u64,
    /// Largest size of the file, bytes; 0 after a write failed.
    limit: u64,
    num_reused: usize,
}

impl RowCache {
    /// Opens or creates a file that will not grow beyond `limit` bytes.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read and written, is not a row cache, or is used by another process.
    pub fn open(path: &Path, limit: u64) -> Result<Self, RowCacheError> {
        let io_error = |error| RowCacheError::Io(path.to_owned(), error);
        let options = File::options().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = options.map_err(io_error)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => RowCacheError::InUse(path.to_owned()),
            TryLockError::Error(error) => io_error(error),
        })?;
        let length = file.metadata().map_err(io_error)?.len();
        if length == 0 {
            file.write_all(HEADER).map_err(io_error)?;
        }
        let (offsets, end) = record_offsets(&mut file, length)
            .map_err(io_error)?
            .ok_or_else(|| RowCacheError::NotOurs(path.to_owned()))?;
        // Drop a record that an aborted run left incomplete.
        file.set_len(end).map_err(io_error)?;
        Ok(Self { path: path.to_owned(), rows: Mutex::new(Rows { file, offsets, end, limit, num_reused: 0 }) })
    }

    /// Number of rows in the file.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows().offsets.len()
    }

    /// Returns true if the file holds no row.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of rows that were read from the file.
    #[must_use]
    pub fn num_reused(&self) -> usize {
        self.rows().num_reused
    }

    fn rows(&self) -> MutexGuard<'_, Rows> {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the row of a fingerprint, or `None` if the file does not hold it or it cannot be read.
    pub(super) fn read(&self, name: u128) -> Option<Row> {
        let mut rows = self.rows();
        let offset = *rows.offsets.get(&name)?;
        let row = read_row_at(&mut rows.file, offset);
        match row {
            Ok(row) => {
                rows.num_reused += 1;
                Some(row)
            }
            Err(error) => {
                log::warn!("{}: {error}; this row is computed anew", self.path.display());
                rows.offsets.remove(&name);
                None
            }
        }
    }

    /// Appends rows until the limit is reached. After a failed write no more rows are appended, but the bake continues.
    pub(super) fn append(&self, found: &[(u128, Row)]) {
        let mut rows = self.rows();
        let mut bytes = Vec::new();
        let mut added = Vec::new();
        for (name, row) in found {
            let offset = rows.end + bytes.len() as u64;
            write_record(*name, row, &mut bytes);
            if rows.end + bytes.len() as u64 > rows.limit {
                bytes.truncate((offset - rows.end) as usize);
                break;
            }
            added.push((*name, offset));
        }
        let end = rows.end;
        match rows.file.seek(SeekFrom::Start(end)).and_then(|_| rows.file.write_all(&bytes)) {
            Ok(()) => {
                rows.end += bytes.len() as u64;
                rows.offsets.extend(added);
            }
            Err(error) => {
                log::warn!("{}: {error}; no more rows are kept", self.path.display());
                rows.limit = 0;
            }
        }
    }
}

/// Returns the offset of each record and the end of the last complete record. Returns `None` if the file is not a row
/// cache.
fn record_offsets(file: &mut File, length: u64) -> io::Result<Option<(HashMap<u128, u64>, u64)>> {
    file.rewind()?;
    let mut reader = BufReader::new(&*file);
    let mut header = [0; HEADER.len()];
    if length > 0 && (length < HEADER.len() as u64 || reader.read_exact(&mut header).is_err() || header != *HEADER) {
        return Ok(None);
    }
    let (mut offsets, mut end) = (HashMap::new(), HEADER.len() as u64);
    while let Some(head) = RecordHead::read(&mut reader, length.saturating_sub(end))? {
        offsets.insert(head.name, end);
        reader.seek_relative(head.num_entry_bytes() as i64)?;
        end += head.num_bytes();
    }
    Ok(Some((offsets, end)))
}

fn read_row_at(file: &mut File, offset: u64) -> io::Result<Row> {
    file.seek(SeekFrom::Start(offset))?;
    let length = file.metadata()?.len();
    let head = RecordHead::read(file, length - offset)?.ok_or(io::ErrorKind::UnexpectedEof)?;
    read_row(file, &head)
}
