//! Parsers of values on the command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use glam::Vec3;

use crate::render::Exposure;

/// Parses one of the values in a table of value, name and hint. The help lists the names with their hints.
pub fn one_of<T, const N: usize>(table: [(T, &'static str, &'static str); N]) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let names = table.map(|(_, name, hint)| PossibleValue::new(name).help(hint));
    PossibleValuesParser::new(names).try_map(move |text| {
        let row = table.iter().find(|(_, name, _)| *name == text);
        row.map(|&(value, ..)| value).ok_or_else(|| format!("{text} is not in the table"))
    })
}

/// Parses a number above zero.
pub fn positive(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && f32::is_finite(value) => Ok(value),
        _ => Err("must be a positive number".to_owned()),
    }
}

/// Parses a number from zero to one.
pub fn share(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("must be a number from 0 to 1".to_owned()),
    }
}

/// Parses the radius of a lamp, metres.
pub fn radius(text: &str) -> Result<f32, String> {
    let parsed = text.parse().ok().filter(|radius: &f32| (0.0..=1e6).contains(radius));
    parsed.ok_or_else(|| "must be a number of metres, 0 or more".to_owned())
}

/// Parses the width of a hemicube, pixels.
pub fn hemicube_size(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(size @ (16 | 32 | 64 | 128 | 256 | 512)) => Ok(size),
        _ => Err("must be 16, 32, 64, 128, 256 or 512".to_owned()),
    }
}

/// Parses an exposure value in stops, or `auto`.
pub fn exposure(text: &str) -> Result<Exposure, String> {
    match text.parse() {
        Ok(ev) if f32::abs(ev) <= 64.0 => Ok(Exposure::Ev(ev)),
        _ if text == "auto" => Ok(Exposure::Auto),
        _ => Err("must be auto or a number from -64 to 64".to_owned()),
    }
}

/// Parses `N` finite numbers separated by commas.
pub fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let numbers: Vec<f32> = text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
    <[f32; N]>::try_from(numbers).ok().filter(|numbers| numbers.iter().all(|number| number.is_finite()))
}

/// Returns the unit vector in this direction.
pub fn unit_normal(normal: Vec3) -> Result<Vec3, String> {
    normal.try_normalize().ok_or_else(|| "the normal has no direction".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_found_by_its_name_in_the_table() {
        let command = clap::Command::new("test")
            .arg(clap::Arg::new("size").value_parser(one_of([(1, "small", ""), (2, "large", "")])));
        let parse = |text| {
            command.clone().try_get_matches_from(["test", text]).map(|found| found.get_one::<i32>("size").copied())
        };
        assert_eq!(parse("large").expect("it is in the table"), Some(2));
        assert!(
            parse("Large").is_err()
                && parse("huge").expect_err("it is not").to_string().contains("[possible values: small, large]")
        );
    }

    #[test]
    fn an_exposure_is_a_number_or_auto() {
        assert_eq!(exposure("auto"), Ok(Exposure::Auto));
        assert_eq!(exposure("-7.5"), Ok(Exposure::Ev(-7.5)));
        for wrong in ["", "bright", "NaN", "inf", "1000"] {
            assert!(exposure(wrong).is_err(), "{wrong}");
        }
    }
}
