//! Tables of points and of irradiance.

use std::path::Path;

use anyhow::{Context, Result};
use glam::Vec3;

use crate::bake::Measured;
use crate::base::colour::luminance;
use crate::raytrace::{Irradiance, MeasuringPoint};

/// The first columns of every table that is written.
const COLUMNS: [&str; 13] = ["px", "py", "pz", "nx", "ny", "nz", "E_r", "E_g", "E_b", "Ed_r", "Ed_g", "Ed_b", "lux"];

/// Formats a table of irradiance, lux; NaN for a point on no surface.
///
/// # Errors
/// Returns an error if the table is not UTF-8.
pub fn table_of_values(points: &[MeasuringPoint], measured: &[Option<Measured>]) -> Result<String> {
    let unknown = Measured { total: Vec3::NAN, direct: Vec3::NAN };
    let rows = points.iter().zip(measured).map(|(point, measured)| {
        let Measured { total, direct } = measured.unwrap_or(unknown);
        let values = [point.position, point.normal, total, direct].map(|v| v.to_array());
        [values.as_flattened(), &[luminance(total)]].concat()
    });
    to_csv(&COLUMNS, rows)
}

/// Formats a table of irradiance and its standard error, lux.
///
/// # Errors
/// Returns an error if the table is not UTF-8.
pub fn table_of_estimates(points: &[MeasuringPoint], estimates: &[Irradiance]) -> Result<String> {
    let rows = points.iter().zip(estimates).map(|(point, Irradiance { total, direct, total_error, .. })| {
        let values = [point.position, point.normal, *total, *direct].map(|v| v.to_array());
        [values.as_flattened(), &[luminance(*total)], &total_error.to_array()].concat()
    });
    to_csv(&[COLUMNS.as_slice(), &["se_r", "se_g", "se_b"]].concat(), rows)
}

fn to_csv(columns: &[&str], rows: impl Iterator<Item = Vec<f32>>) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns)?;
    for row in rows {
        writer.write_record(row.iter().map(f32::to_string))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Reads a table of points.
///
/// # Errors
/// Returns an error if the file cannot be read, a column is missing, or a value is not a number.
pub fn read_points(path: &Path) -> Result<Vec<MeasuringPoint>> {
    let name = path.display();
    let mut reader =
        csv::ReaderBuilder::new().flexible(true).from_path(path).with_context(|| format!("{name}: cannot be read"))?;
    let header = reader.headers().with_context(|| format!("{name}: cannot be read"))?.clone();
    let mut columns = [0; 6];
    for (column, wanted) in columns.iter_mut().zip(COLUMNS) {
        *column = header
            .iter()
            .position(|title| title.trim() == wanted)
            .with_context(|| format!("{name}: there is no column {wanted} in the header"))?;
    }
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.with_context(|| format!("{name}: cannot be read"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut values = [0.0; 6];
        for (value, column) in values.iter_mut().zip(columns) {
            let text = record.get(column).unwrap_or_default().trim();
            *value = text.parse().ok().filter(|value: &f32| value.is_finite()).with_context(|| {
                format!("{name}, line {line}: \"{text}\" in column {} is no number", &header[column])
            })?;
        }
        let [px, py, pz, nx, ny, nz] = values;
        let normal = Vec3::new(nx, ny, nz).try_normalize();
        let normal = normal.with_context(|| format!("{name}, line {line}: the normal has no direction"))?;
        points.push(MeasuringPoint { position: Vec3::new(px, py, pz), normal });
    }
    Ok(points)
}
