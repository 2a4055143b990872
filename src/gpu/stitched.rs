//! A WGSL module concatenated from files, and naga's errors with the file and line to which they refer.
//!
//! naga reads one text, so its locations are offsets into the whole. [`Stitched::check`] maps each location back to the
//! file from which the text came.

use std::error::Error;

use naga::{SourceLocation, Span};

/// Concatenated WGSL files.
pub(super) struct Stitched<'a> {
    /// Pairs of file name below the folder of shaders and text, in order.
    pub parts: Vec<(&'a str, String)>,
}

impl Stitched<'_> {
    /// Returns the whole text, with a line break between the files.
    pub fn text(&self) -> String {
        self.parts.iter().map(|(_, text)| text.as_str()).collect::<Vec<_>>().join("\n")
    }

    /// Parses and validates the module.
    ///
    /// # Errors
    /// Returns naga's message if the module is invalid: `FILE:LINE:COLUMN: MESSAGE`, and below it the line with the
    /// location marked.
    pub fn check(&self) -> Result<(), String> {
        let text = self.text();
        let module = naga::front::wgsl::parse_str(&text).map_err(|error| {
            let labels = error.labels().map(|(span, label)| (span, label.to_owned())).collect();
            self.message(&text, error.message(), labels)
        })?;
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
            .validate(&module)
            .map_err(|error| self.message(&text, &with_causes(error.as_inner()), error.spans().cloned().collect()))?;
        Ok(())
    }

    fn message(&self, text: &str, headline: &str, labels: Vec<(Span, String)>) -> String {
        let mut message = String::new();
        for (span, label) in labels.into_iter().filter(|(span, _)| span.is_defined()) {
            let SourceLocation { line_number, line_position, length, .. } = span.location(text);
            let (file, line) = self.locate(line_number);
            let code = text.lines().nth(line_number as usize - 1).unwrap_or("");
            let column = line_position as usize;
            let rest = code.len().saturating_sub(column - 1).max(1);
            let headline = if message.is_empty() { headline } else { "see also" };
            message += &format!("{file}:{line}:{column}: {headline}\n{code}\n");
            message += &format!("{}{} {label}\n", " ".repeat(column - 1), "^".repeat((length as usize).clamp(1, rest)));
        }
        if message.is_empty() {
            let files: Vec<&str> = self.parts.iter().map(|(file, _)| *file).collect();
            return format!("{}: {headline}", files.join(" + "));
        }
        message.trim_end().to_owned()
    }

    /// Maps a line of the whole text to its file and its line there; lines count from 1.
    fn locate(&self, line: u32) -> (&str, u32) {
        let mut rest = line;
        for (file, text) in &self.parts {
            // The separator ends the last line of the part. That line is empty if the file ends in a line break.
            let num_lines = 1 + text.matches('\n').count() as u32;
            if rest <= num_lines {
                return (file, rest);
            }
            rest -= num_lines;
        }
        ("the shader", line)
    }
}

/// Returns the messages of an error and of its causes, the innermost last.
fn with_causes(error: &(dyn Error + 'static)) -> String {
    let causes = std::iter::successors(Some(error), |&error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stitched(parts: &[(&'static str, &str)]) -> Stitched<'static> {
        Stitched { parts: parts.iter().map(|&(file, text)| (file, text.to_owned())).collect() }
    }

    #[test]
    fn a_line_of_the_whole_is_mapped_to_the_line_of_its_file() {
        let shader = stitched(&[("a.wgsl", "1\n2\n"), ("b.wgsl", "1"), ("c.wgsl", "1\n2\n3\n")]);
        let lines: Vec<_> = shader.text().lines().map(str::to_owned).collect();
        let located: Vec<_> = (1..=lines.len()).map(|line| shader.locate(line as u32)).collect();
        assert_eq!(lines, ["1", "2", "", "1", "1", "2", "3"]);
        assert_eq!(located[..4], [("a.wgsl", 1), ("a.wgsl", 2), ("a.wgsl", 3), ("b.wgsl", 1)]);
        assert_eq!(located[4..], [("c.wgsl", 1), ("c.wgsl", 2), ("c.wgsl", 3)]);
    }

    #[test]
    fn an_error_of_the_parser_names_the_file_and_the_line() {
        let shader = stitched(&[
            ("shared/good.wgsl", "fn half(x: f32) -> f32 {\n    return 0.5 * x;\n}\n"),
            ("bad.wgsl", "fn twice(x: f32) -> f32 {\n    return 2.0 * y;\n}\n"),
        ]);
        let message = shader.check().expect_err("y is unknown");
        assert!(message.starts_with("bad.wgsl:2:18: no definition in scope for identifier: `y`"), "{message}");
        assert!(message.contains("    return 2.0 * y;\n                 ^ "), "{message}");
    }

    #[test]
    fn an_error_of_the_validator_names_the_file_and_the_line() {
        let shader = stitched(&[
            ("shared/good.wgsl", "fn half(x: f32) -> f32 {\n    return 0.5 * x;\n}\n"),
            ("bad.wgsl", "@fragment\nfn fragment() -> @location(0) u32 {\n    return 1.5;\n}\n"),
        ]);
        let message = shader.check().expect_err("a float is no u32");
        assert!(message.starts_with("bad.wgsl:3:"), "{message}");
    }

    #[test]
    fn a_valid_module_passes() {
        assert_eq!(stitched(&[("a.wgsl", "const A: f32 = 1.0;\n"), ("b.wgsl", "const B: f32 = A;\n")]).check(), Ok(()));
    }
}
