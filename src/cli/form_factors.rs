//! `hemicube form-factors`: view factors between pairs of polygons, from a table to a table.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use clap::{Args, ValueEnum};
use glam::DVec3;

use super::value::hemicube_size;
use crate::base::output::write_whole;
use crate::form_factor::polygon_pair::{Estimate, Polygon, PolygonPair};
use crate::gpu::Gpu;

/// Options of `hemicube form-factors`.
#[derive(Args, Debug)]
pub struct FormFactorArgs {
    /// Table of pairs: a header, then name,polygon_A,polygon_B,blocker a line. Polygons are convex and planar, written
    /// as "x y z;x y z;..." in metres, counter-clockwise as seen from the front; the blocker may be empty; further
    /// columns are ignored.
    pub pairs: PathBuf,
    /// How form factors are computed.
    #[arg(long, value_enum, value_name = "METHOD")]
    pub method: PairMethod,
    /// Table of form factors, in the same order: name,F_AB,stderr.
    #[arg(short, long, value_name = "F.csv")]
    pub output: PathBuf,
    /// With hemicube: width of the hemicubes, pixels: a power of two from 16 to 512.
    #[arg(long, value_name = "PX", default_value = "256", value_parser = hemicube_size)]
    pub hemicube_size: u32,
}

/// How form factors are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PairMethod {
    /// Closed forms: contour integrals, and Lambert's formula if there is a blocker.
    Analytic,
    /// Cosine-distributed rays; needs no GPU.
    Hemisphere,
    /// Item buffers drawn by the GPU.
    Hemicube,
}

/// Computes and writes the form factors.
///
/// # Errors
/// Returns an error if the pairs cannot be read, hemicubes have no driver, or the table cannot be written.
pub fn run(args: &FormFactorArgs) -> Result<()> {
    let pairs = read_pairs(&args.pairs)?;
    let gpu = match args.method {
        PairMethod::Hemicube => Some(Gpu::headless()?),
        PairMethod::Analytic | PairMethod::Hemisphere => None,
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["name", "F_AB", "stderr"])?;
    for (name, pair) in &pairs {
        let Estimate { factor, error } = match (args.method, &gpu) {
            (PairMethod::Hemicube, Some(gpu)) => pair.by_hemicubes(gpu, args.hemicube_size)?,
            (PairMethod::Hemisphere, _) => pair.by_hemispheres()?,
            _ => pair.analytic(),
        };
        writer.write_record([name, &factor.to_string(), &error.to_string()])?;
    }
    write_whole(&args.output, &writer.into_inner()?)
        .with_context(|| format!("{}: cannot be written", args.output.display()))
}

/// Reads the named pairs of a table.
fn read_pairs(path: &Path) -> Result<Vec<(String, PolygonPair)>> {
    let name = path.display();
    let unreadable = || format!("{name}: cannot be read");
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).with_context(unreadable)?;
    let header = reader.headers().with_context(unreadable)?.clone();
    let find = |title: &str| header.iter().position(|column| column.trim() == title);
    let column = |title: &str| find(title).ok_or_else(|| anyhow!("{name}: there is no column {title} in the header"));
    let (name_at, a_at, b_at, blocker_at) =
        (column("name")?, column("polygon_A")?, column("polygon_B")?, find("blocker"));
    let mut pairs = Vec::new();
    for record in reader.records() {
        let record = record.with_context(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        let field = |at: usize| record.get(at).unwrap_or_default().trim();
        let polygon = |title: &str, text: &str| {
            parse_polygon(text).map_err(|cause| anyhow!("{name}, line {line}: {title}: {cause}"))
        };
        let blocker = blocker_at.map(field).filter(|text| !text.is_empty());
        let pair = PolygonPair {
            a: polygon("polygon_A", field(a_at))?,
            b: polygon("polygon_B", field(b_at))?,
            blocker: blocker.map(|text| polygon("blocker", text)).transpose()?,
        };
        pairs.push((field(name_at).to_owned(), pair));
    }
    Ok(pairs)
}

/// Parses "x y z;x y z;...".
fn parse_polygon(text: &str) -> Result<Polygon> {
    let corner = |text: &str| -> Result<DVec3> {
        let numbers: Vec<f64> = text
            .split_whitespace()
            .map(|number| number.parse().map_err(|_| anyhow!("\"{number}\" is no number")))
            .collect::<Result<_>>()?;
        <[f64; 3]>::try_from(numbers)
            .map(DVec3::from)
            .map_err(|numbers| anyhow!("a corner needs three coordinates, \"{}\" has {}", text.trim(), numbers.len()))
    };
    let corners = text.trim_end_matches(';').split(';').map(corner).collect::<Result<Vec<_>>>()?;
    Ok(Polygon::new(corners)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_are_read_or_refused_with_the_cause() {
        assert_eq!(parse_polygon("0 0 0;1 0 0;1 1 0").map(|p| p.area()).expect("a triangle"), 0.5);
        for (text, cause) in [
            ("", "three coordinates"),
            ("0 0 0;1 0;1 1 0", "\"1 0\" has 2"),
            ("0 0 0;1 0 x;1 1 0", "\"x\" is no number"),
            ("0 0 0;1 0 0;2 0 0", "on a line"),
            ("0 0 0;1 0 0;nan 1 0", "not finite"),
        ] {
            let message = format!("{:#}", parse_polygon(text).expect_err(text));
            assert!(message.contains(cause), "{text}: {message}");
        }
    }
}
