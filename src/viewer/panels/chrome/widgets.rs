//! Widgets and number formats that several panels share.

use std::collections::BTreeMap;
use std::time::Duration;

use egui::{CollapsingHeader, Ui};

use super::theme;

/// Adds a section that can be folded. `sections` stores by title whether it is open.
pub fn section(
    ui: &mut Ui,
    sections: &mut BTreeMap<String, bool>,
    title: &str,
    is_open_at_first: bool,
    contents: impl FnOnce(&mut Ui),
) {
    let is_open = sections.get(title).copied().unwrap_or(is_open_at_first);
    let header = CollapsingHeader::new(theme::title(title)).open(Some(is_open)).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
    });
    ui.add_space(2.0);
    ui.separator();
    if header.header_response.clicked() {
        sections.insert(title.to_owned(), !is_open);
    }
}

/// Adds a row with a name at the left and a value at the right.
pub fn row(ui: &mut Ui, name: &str, value: impl Into<egui::WidgetText>) {
    ui.horizontal(|ui| {
        ui.label(name);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.add(egui::Label::new(value).truncate());
        });
    });
}

/// Sets the accessible name of a widget without text, for screen readers.
pub fn named(response: &egui::Response, role: egui::Role, name: impl ToString) {
    response.widget_info(|| egui::WidgetInfo::labeled(role, response.enabled(), name.to_string()));
}

/// Adds weak text that wraps.
pub fn hint(ui: &mut Ui, text: impl Into<String>) {
    ui.add(egui::Label::new(egui::RichText::new(text).weak()).wrap());
}

/// Adds a button as wide as the panel. Returns true if it was clicked.
pub fn wide_button(ui: &mut Ui, text: &str, is_enabled: bool, hover: &str) -> bool {
    let button = egui::Button::new(text);
    let response = ui.vertical_centered_justified(|ui| ui.add_enabled(is_enabled, button)).inner;
    response.on_hover_text(hover).clicked()
}

/// Returns `name` with a capital first letter.
#[must_use]
pub fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Formats a number with thin spaces between thousands.
#[must_use]
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// Formats an illuminance in lux with about three significant digits.
#[must_use]
pub fn lux(value: f32) -> String {
    match value.abs() {
        v if v >= 100.0 => grouped(value.round().max(0.0) as usize),
        v if v >= 10.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

/// Formats a length in metres, or in centimetres below one metre.
#[must_use]
pub fn metres(length: f32) -> String {
    if length < 1.0 { format!("{:.0} cm", (100.0 * length).max(1.0)) } else { format!("{length:.1} m") }
}

/// Formats a duration as `12.3 s` or `2:05 min`.
#[must_use]
pub fn clock(elapsed: Duration) -> String {
    let seconds = elapsed.as_secs();
    if seconds < 60 {
        format!("{:.1} s", elapsed.as_secs_f32())
    } else {
        format!("{}:{:02} min", seconds / 60, seconds % 60)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_separated() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1\u{2009}234\u{2009}567");
    }

    #[test]
    fn lux_and_lengths_are_rounded_for_reading() {
        assert_eq!((lux(1234.4), lux(56.78), lux(0.456)), ("1\u{2009}234".into(), "56.8".into(), "0.46".into()));
        assert_eq!((metres(0.123), metres(2.34)), ("12 cm".into(), "2.3 m".into()));
    }

    #[test]
    fn durations_are_in_seconds_or_minutes() {
        assert_eq!(clock(Duration::from_millis(12_340)), "12.3 s");
        assert_eq!(clock(Duration::from_secs(125)), "2:05 min");
    }
}
