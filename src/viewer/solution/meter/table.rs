//! Readings as a CSV file. The first columns are those of `hemicube measure`, so that the same points can be measured
//! again.

use std::path::{Path, PathBuf};

use anyhow::Context;

use super::{Grid, Reading};
use crate::bake::Measured;
use crate::base::colour::luminance;
use crate::base::output::write_whole;
use crate::raytrace::MeasuringPoint;
use crate::viewer::solution::file_names::next_free_name;

/// Names of the columns.
const COLUMNS: [&str; 15] =
    ["px", "py", "pz", "nx", "ny", "nz", "E_r", "E_g", "E_b", "Ed_r", "Ed_g", "Ed_b", "lux", "surface", "patch"];

/// Formats the table: all pinned readings, then all points of the grid.
///
/// # Errors
/// Returns an error if the CSV writer fails. It does not fail when it writes to memory, as here.
pub(super) fn table_of(pins: &[Reading], grid: Option<&Grid>) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS)?;
    for reading in pins {
        let surface = reading.surface.as_ref();
        let name = surface.map_or(String::new(), |surface| surface.instance.clone());
        let patch = surface.map_or(String::new(), |surface| surface.patch.to_string());
        writer.write_record(record(&reading.point, &reading.measured).into_iter().chain([name, patch]))?;
    }
    for (point, measured) in grid.iter().flat_map(|grid| grid.plan.points.iter().zip(&grid.measured)) {
        writer.write_record(record(point, measured).into_iter().chain(["grid".to_owned(), String::new()]))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Writes the table into `folder` as the next free `hemicube-lux-NNN.csv`.
///
/// # Errors
/// Returns an error if the file cannot be written or all 999 names are taken.
pub fn write_table(folder: &Path, pins: &[Reading], grid: Option<&Grid>) -> anyhow::Result<PathBuf> {
    let path =
        next_free_name(folder, "hemicube-lux", "csv").context("there are a thousand tables in this folder already")?;
    write_whole(&path, table_of(pins, grid)?.as_bytes())
        .with_context(|| format!("{}: cannot be written", path.display()))?;
    Ok(path)
}

fn record(point: &MeasuringPoint, Measured { total, direct }: &Measured) -> Vec<String> {
    let values = [point.position, point.normal, *total, *direct].map(|v| v.to_array());
    values.as_flattened().iter().chain(&[luminance(*total)]).map(ToString::to_string).collect()
}
