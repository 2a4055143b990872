//! Parser of photometric files (IES LM-63, editions 1986 to 2019) with type C photometry.

use super::distribution::Photometry;

/// Largest number of intensities of a table.
const MAX_TABLE: usize = 1 << 20;

/// Number of values between the TILT data and the angles.
const HEADER: usize = 13;

/// Reads the intensities from the bytes of a file.
///
/// # Errors
/// Returns an error if the file is not LM-63, is incomplete or invalid, is not type C, or has no positive intensity.
/// The error is one sentence.
pub fn parse(bytes: &[u8]) -> Result<Photometry, String> {
    let text = String::from_utf8_lossy(bytes);
    let (_, after) =
        text.split_once("TILT=").ok_or("it has no line TILT=: it is not a photometric file (IES LM-63)")?;
    let (tilt, rest) = after.split_once('\n').ok_or("it ends after TILT=")?;
    let mut numbers = rest.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let mut next = || -> Result<f32, String> {
        let word = numbers.next().ok_or("it is cut off")?;
        let number = word.parse().ok().filter(|number: &f32| number.is_finite());
        number.ok_or_else(|| format!("{:?} is not a number", word.chars().take(20).collect::<String>()))
    };
    if tilt.trim() == "INCLUDE" {
        // Skips the lamp's position and the table of a tilted lamp: pairs of an angle and a flux factor.
        next()?;
        let pairs = count(next()?)?;
        (0..2 * pairs).try_for_each(|_| next().map(drop))?;
    }
    let header = (0..HEADER).map(|_| next()).collect::<Result<Vec<f32>, String>>()?;
    let [
        _lamps,
        _lumens,
        multiplier,
        num_vertical,
        num_horizontal,
        kind,
        _units,
        _width,
        _length,
        _height,
        ballast,
        lamp,
        _watts,
    ] = header[..]
    else {
        return Err("it is cut off".to_owned());
    };
    if kind != 1.0 {
        let name = if kind == 2.0 {
            "B".to_owned()
        } else if kind == 3.0 {
            "A".to_owned()
        } else {
            kind.to_string()
        };
        return Err(format!("its photometry is of type {name}; only type C is supported"));
    }
    let (num_vertical, num_horizontal) = (count(num_vertical)?, count(num_horizontal)?);
    if num_vertical == 0 || num_horizontal == 0 || num_vertical.saturating_mul(num_horizontal) > MAX_TABLE {
        return Err(format!("it has a table of {num_horizontal} by {num_vertical} intensities"));
    }
    let mut list = |length: usize| (0..length).map(|_| next()).collect::<Result<Vec<f32>, String>>();
    let (vertical, horizontal) = (list(num_vertical)?, list(num_horizontal)?);
    let is_growing = |angles: &[f32]| angles.windows(2).all(|pair| pair[0] < pair[1]);
    if !is_growing(&vertical) || !is_growing(&horizontal) {
        return Err("its angles are not ascending".to_owned());
    }
    let factor = multiplier * ballast * lamp;
    let candela: Vec<f32> =
        list(num_vertical * num_horizontal)?.iter().map(|value| (value * factor).max(0.0)).collect();
    let peak = candela.iter().copied().fold(0.0, f32::max);
    if peak <= 0.0 || !peak.is_finite() {
        return Err("its intensities are not above 0".to_owned());
    }
    Ok(Photometry { vertical, horizontal, candela, peak, file: bytes.to_vec() })
}

fn count(number: f32) -> Result<usize, String> {
    let is_whole = number >= 0.0 && number.fract() == 0.0 && number <= MAX_TABLE as f32;
    if is_whole { Ok(number as usize) } else { Err(format!("{number} is not a count")) }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    const WITH_TILT: &str = "IESNA:LM-63-1995\n[MANUFAC] none\nTILT=INCLUDE\n1\n2\n0 90\n1.0 0.8\n\
        1 1000 2.0 2 1 1 1 0.1 0.1 0\n0.5 1.0 100\n0, 90\n0\n40, 20\n";

    #[test]
    fn factors_are_applied_and_keywords_and_tilt_are_skipped() {
        let table = parse(WITH_TILT.as_bytes()).expect("LM-63");
        assert_eq!((table.peak(), table.intensity(Vec3::NEG_Z)), (40.0, 40.0));
        assert!((table.intensity(Vec3::X) - 20.0).abs() < 1e-3);
        assert_eq!(table.file(), WITH_TILT.as_bytes());
    }

    #[test]
    fn each_error_has_its_message() {
        let broken = |from: &str, to: &str| parse(WITH_TILT.replacen(from, to, 1).as_bytes()).expect_err("broken");
        assert!(broken("TILT", "tilt").contains("no line TILT="));
        assert!(broken("40, 20", "40").contains("cut off"));
        assert!(broken("2 1 1 1 0.1", "2 1 2 1 0.1").contains("type B"));
        assert!(broken("0, 90", "90, 0").contains("not ascending"));
        assert!(broken("40, 20", "0, 0").contains("not above 0"));
        assert!(broken("40, 20", "nan, x").contains("is not a number"));
        assert!(broken("2.0 2 1 1", "2.0 9999999 9999999 1").contains("is not a count"));
        assert!(broken("2.0 2 1 1", "2.0 0 1 1").contains("0 intensities"));
    }
}
