//! Rows of form factors in a file: what was found once is not found again, after a bake was stopped or when lamps and
//! colours have changed.
//!
//! A row is named by what it depends on: the elements, the method and the viewpoint, and not by light. The file is a
//! header and records, written one after the other, so that a stopped run leaves whole records and at most a broken last one.

use std::collections::HashMap;
use std::fs::{File, TryLockError};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;
use thiserror::Error;

use super::row_file::{HEADER, RecordHead, read_row, write_record};
use super::{Entry, FormFactorError, FormFactors, Row, Viewpoint};
use crate::base::fingerprint::Fingerprint;
use crate::patch::PatchMesh;

/// Rows read at a time.
const ROWS_A_BATCH: usize = 64;

/// A row cache could not be opened.
#[derive(Debug, Error)]
pub enum RowCacheError {
    /// The file cannot be opened, read or begun.
    #[error("{}: cannot be used as a row cache: {}", .0.display(), .1)]
    Io(PathBuf, io::Error),
    /// The file is something else and shall not be overwritten.
    #[error("{}: is not a row cache of Hemicube; name another file, or delete this one", .0.display())]
    NotOurs(PathBuf),
    /// Two bakes would write into each other's rows.
    #[error("{}: another bake is using this row cache", .0.display())]
    InUse(PathBuf),
}

/// Rows in a file.
#[derive(Debug)]
pub struct RowCache {
    path: PathBuf,
    rows: Mutex<Rows>,
}

#[derive(Debug)]
struct Rows {
    file: File,
    /// Where the record of each row begins.
    places: HashMap<u128, u64>,
    end: u64,
    /// The file does not grow beyond this; 0 once it could not be written.
    limit: u64,
    num_reused: usize,
}

impl RowCache {
    /// Opens a file or begins one, which will not grow beyond `limit` bytes.
    ///
    /// # Errors
    /// The file cannot be read and written, is not a row cache, or another process uses it.
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
        let (places, end) =
            places(&mut file, length).map_err(io_error)?.ok_or_else(|| RowCacheError::NotOurs(path.to_owned()))?;
        // What a stopped run left unfinished is written over.
        file.set_len(end).map_err(io_error)?;
        Ok(Self { path: path.to_owned(), rows: Mutex::new(Rows { file, places, end, limit, num_reused: 0 }) })
    }

    /// How many rows are in the file.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows().places.len()
    }

    /// No row is in the file.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many rows were taken from the file.
    #[must_use]
    pub fn num_reused(&self) -> usize {
        self.rows().num_reused
    }

    fn rows(&self) -> MutexGuard<'_, Rows> {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A row that is in the file and can be read.
    fn read(&self, name: u128) -> Option<Row> {
        let mut rows = self.rows();
        let place = *rows.places.get(&name)?;
        let row = read_row_at(&mut rows.file, place);
        match row {
            Ok(row) => {
                rows.num_reused += 1;
                Some(row)
            }
            Err(error) => {
                log::warn!("{}: {error}; this row is found anew", self.path.display());
                rows.places.remove(&name);
                None
            }
        }
    }

    /// Appends rows while there is room for them. A disk that is full costs the cache, not the bake.
    fn append(&self, found: &[(u128, Row)]) {
        let mut rows = self.rows();
        let mut bytes = Vec::new();
        let mut added = Vec::new();
        for (name, row) in found {
            let place = rows.end + bytes.len() as u64;
            write_record(*name, row, &mut bytes);
            if rows.end + bytes.len() as u64 > rows.limit {
                bytes.truncate((place - rows.end) as usize);
                break;
            }
            added.push((*name, place));
        }
        let end = rows.end;
        match rows.file.seek(SeekFrom::Start(end)).and_then(|_| rows.file.write_all(&bytes)) {
            Ok(()) => {
                rows.end += bytes.len() as u64;
                rows.places.extend(added);
            }
            Err(error) => {
                log::warn!("{}: {error}; no more rows are kept", self.path.display());
                rows.limit = 0;
            }
        }
    }
}

/// Where each record begins, and where the last whole one ends; none where the file is something else.
fn places(file: &mut File, length: u64) -> io::Result<Option<(HashMap<u128, u64>, u64)>> {
    file.rewind()?;
    let mut reader = BufReader::new(&*file);
    let mut header = [0; HEADER.len()];
    if length > 0 && (length < HEADER.len() as u64 || reader.read_exact(&mut header).is_err() || header != *HEADER) {
        return Ok(None);
    }
    let (mut places, mut end) = (HashMap::new(), HEADER.len() as u64);
    while let Some(head) = RecordHead::read(&mut reader, length.saturating_sub(end))? {
        places.insert(head.name, end);
        reader.seek_relative(head.num_entry_bytes() as i64)?;
        end += head.num_bytes();
    }
    Ok(Some((places, end)))
}

fn read_row_at(file: &mut File, place: u64) -> io::Result<Row> {
    file.seek(SeekFrom::Start(place))?;
    let length = file.metadata()?.len();
    let head = RecordHead::read(file, length - place)?.ok_or(io::ErrorKind::UnexpectedEof)?;
    read_row(file, &head)
}

/// A method whose rows are kept in a [`RowCache`].
pub struct CachedRows<'a> {
    method: Box<dyn FormFactors + 'a>,
    cache: &'a RowCache,
    /// Of the elements and the method.
    base: Fingerprint,
    num_elements: usize,
}

impl<'a> CachedRows<'a> {
    /// Keeps the rows that `method`, which is told from others by `label`, finds of the elements of `mesh`.
    #[must_use]
    pub fn new(method: Box<dyn FormFactors + 'a>, label: &str, mesh: &PatchMesh, cache: &'a RowCache) -> Self {
        let mut base = Fingerprint::default();
        base.add(label.as_bytes());
        for element in &mesh.elements {
            let corners = element.vertices.map(|v| mesh.vertices[v as usize].position);
            corners.iter().for_each(|corner| base.add(bytemuck::bytes_of(corner)));
            // Holes are in the area; light and reflectance are not part of it.
            base.add(&element.area.to_le_bytes());
            base.add(&[u8::from(element.is_back)]);
        }
        Self { method, cache, base, num_elements: mesh.elements.len() }
    }

    fn name(&self, viewpoint: &Viewpoint) -> u128 {
        let mut name = self.base;
        name.add(bytemuck::bytes_of(&viewpoint.position));
        name.add(bytemuck::bytes_of(&viewpoint.normal));
        name.add(&viewpoint.seed.to_le_bytes());
        name.value()
    }

    /// A row of the file, as far as it speaks of elements that there are.
    fn read(&self, name: u128) -> Option<Row> {
        let is_known = |entry: &Entry| entry.element.index() < self.num_elements;
        self.cache.read(name).filter(|row| row.entries.iter().chain(&row.backs).all(is_known))
    }
}

impl FormFactors for CachedRows<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        go_on: &dyn Fn() -> bool,
        take: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let mut missing = Vec::new();
        for (batch, places) in viewpoints.chunks(ROWS_A_BATCH).enumerate() {
            if !go_on() {
                return Ok(missing.first().map_or(batch * ROWS_A_BATCH, |&(first, _)| first));
            }
            let first = batch * ROWS_A_BATCH;
            let names: Vec<u128> = places.iter().map(|viewpoint| self.name(viewpoint)).collect();
            let rows: Vec<Option<Row>> = names.iter().map(|&name| self.read(name)).collect();
            rows.par_iter().enumerate().for_each(|(i, row)| row.iter().for_each(|row| take(first + i, row)));
            let unknown = rows.iter().zip(names).enumerate().filter(|(_, (row, _))| row.is_none());
            missing.extend(unknown.map(|(i, (_, name))| (first + i, name)));
        }
        let asked: Vec<Viewpoint> = missing.iter().map(|&(index, _)| viewpoints[index]).collect();
        let found = Mutex::new(Vec::with_capacity(asked.len()));
        let num_found = self.method.rows(&asked, go_on, &|i, row| {
            let (index, name) = missing[i];
            found.lock().unwrap_or_else(PoisonError::into_inner).push((name, row.clone()));
            take(index, row);
        })?;
        self.cache.append(&found.into_inner().unwrap_or_else(PoisonError::into_inner));
        Ok(missing.get(num_found).map_or(viewpoints.len(), |&(first, _)| first))
    }

    fn num_samples(&self) -> usize {
        self.method.num_samples()
    }
}
