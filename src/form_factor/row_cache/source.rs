//! A source of form factors that reads rows from a file and computes only those that are missing.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::cache::RowCache;
use crate::base::fingerprint::Fingerprint;
use crate::form_factor::{Entry, FormFactorError, FormFactorSource, Row, Viewpoint};
use crate::patch::PatchMesh;

/// Number of rows read at a time.
const ROWS_A_BATCH: usize = 64;

/// A source whose rows are stored in a [`RowCache`].
pub struct CachedFormFactors<'a> {
    source: Box<dyn FormFactorSource + 'a>,
    cache: &'a RowCache,
    /// Fingerprint of the elements and the method.
    base: Fingerprint,
    num_elements: usize,
}

impl<'a> CachedFormFactors<'a> {
    /// Stores the rows that `source` computes over the elements of `mesh`. `label` identifies the method and its
    /// settings, because other settings give other rows.
    #[must_use]
    pub fn new(source: Box<dyn FormFactorSource + 'a>, label: &str, mesh: &PatchMesh, cache: &'a RowCache) -> Self {
        let mut base = Fingerprint::default();
        base.add(label.as_bytes());
        for element in &mesh.elements {
            let corners = element.vertices.map(|v| mesh.vertices[v as usize].position);
            corners.iter().for_each(|corner| base.add(bytemuck::bytes_of(corner)));
            // The area accounts for holes; light and reflectance do not matter.
            base.add(&element.area.to_le_bytes());
            base.add(&[u8::from(element.is_back)]);
        }
        Self { source, cache, base, num_elements: mesh.elements.len() }
    }

    /// Fingerprint of the row of a viewpoint.
    fn name(&self, viewpoint: &Viewpoint) -> u128 {
        let mut name = self.base;
        name.add(bytemuck::bytes_of(&viewpoint.position));
        name.add(bytemuck::bytes_of(&viewpoint.normal));
        name.add(&viewpoint.seed.to_le_bytes());
        name.value()
    }

    /// Reads a row of the file. Returns `None` if it is missing or refers to elements that do not exist.
    fn read(&self, name: u128) -> Option<Row> {
        let is_known = |entry: &Entry| entry.element.index() < self.num_elements;
        self.cache.read(name).filter(|row| row.entries.iter().chain(&row.backs).all(is_known))
    }
}

impl FormFactorSource for CachedFormFactors<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        visit: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        let mut missing = Vec::new();
        for (batch, some) in viewpoints.chunks(ROWS_A_BATCH).enumerate() {
            if !may_continue() {
                return Ok(missing.first().map_or(batch * ROWS_A_BATCH, |&(first, _)| first));
            }
            let first = batch * ROWS_A_BATCH;
            let names: Vec<u128> = some.iter().map(|viewpoint| self.name(viewpoint)).collect();
            let rows: Vec<Option<Row>> = names.iter().map(|&name| self.read(name)).collect();
            rows.par_iter().enumerate().for_each(|(i, row)| row.iter().for_each(|row| visit(first + i, row)));
            let unknown = rows.iter().zip(names).enumerate().filter(|(_, (row, _))| row.is_none());
            missing.extend(unknown.map(|(i, (_, name))| (first + i, name)));
        }
        let missing_viewpoints: Vec<Viewpoint> = missing.iter().map(|&(index, _)| viewpoints[index]).collect();
        let found = Mutex::new(Vec::with_capacity(missing_viewpoints.len()));
        let num_found = self.source.rows(&missing_viewpoints, may_continue, &|i, row| {
            let (index, name) = missing[i];
            found.lock().unwrap_or_else(PoisonError::into_inner).push((name, row.clone()));
            visit(index, row);
        })?;
        self.cache.append(&found.into_inner().unwrap_or_else(PoisonError::into_inner));
        Ok(missing.get(num_found).map_or(viewpoints.len(), |&(first, _)| first))
    }

    fn num_samples(&self) -> usize {
        self.source.num_samples()
    }
}
