//! Keyboard shortcuts: the action of each key.
//!
//! Letters are identified by their position on the keyboard, as the keys of movement are. Other signs are identified by
//! their symbol.

use winit::event::KeyEvent;
use winit::keyboard::{Key, KeyCode, PhysicalKey};

use crate::viewer::action::Action;
use crate::viewer::settings::tool::Tool;

/// Returns the action of a key press.
#[must_use]
pub fn action_of(event: &KeyEvent, is_control_down: bool) -> Option<Action> {
    if let Key::Character(sign) = &event.logical_key {
        match sign.as_str() {
            "+" | "=" => return Some(Action::StepExposure(1.0)),
            "-" => return Some(Action::StepExposure(-1.0)),
            _ => {}
        }
    }
    match event.physical_key {
        PhysicalKey::Code(code) if !event.repeat => {
            bookmark(code, is_control_down).or_else(|| if is_control_down { None } else { action_of_code(code) })
        }
        _ => None,
    }
}

/// Returns the action of a number key: go to a bookmark; with control, set it.
fn bookmark(code: KeyCode, is_control_down: bool) -> Option<Action> {
    use KeyCode::*;
    let digits = [Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9];
    let number = 1 + digits.iter().position(|&digit| digit == code)? as u8;
    Some(if is_control_down { Action::SetBookmark(number) } else { Action::GoToBookmark(number) })
}

fn action_of_code(code: KeyCode) -> Option<Action> {
    Some(match code {
        KeyCode::KeyH | KeyCode::F1 => Action::ToggleHelp,
        KeyCode::KeyP => Action::TogglePanels,
        KeyCode::F11 => Action::ToggleFullScreen,
        KeyCode::F12 => Action::Screenshot,
        KeyCode::KeyF => Action::ToggleWalking,
        KeyCode::Home => Action::FrameAll,
        KeyCode::PageUp => Action::StepCamera(-1),
        KeyCode::PageDown => Action::StepCamera(1),
        KeyCode::KeyX => Action::ToggleAutoExposure,
        KeyCode::KeyT => Action::NextToneMap,
        KeyCode::KeyV => Action::NextShading,
        KeyCode::KeyJ => Action::ToggleDirect,
        KeyCode::KeyK => Action::ToggleIndirect,
        KeyCode::KeyR => Action::ToggleStills,
        KeyCode::KeyM => Action::SelectTool(Tool::Meter),
        KeyCode::KeyG => Action::SelectTool(Tool::Grid),
        KeyCode::KeyN => Action::SelectTool(Tool::PatchView),
        KeyCode::KeyL => Action::SelectTool(Tool::Choose),
        KeyCode::Enter => Action::PinReading,
        KeyCode::KeyO => Action::ChooseFile,
        KeyCode::F5 => Action::Reload,
        KeyCode::KeyB => Action::ToggleBake,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_movement_are_not_shortcuts() {
        use KeyCode::*;
        for code in [KeyW, KeyA, KeyS, KeyD, KeyQ, KeyE, KeyC, Space, ShiftLeft, ArrowLeft, ArrowUp] {
            assert_eq!(action_of_code(code), None, "{code:?}");
        }
    }

    #[test]
    fn number_keys_go_to_bookmarks_and_set_them_with_control() {
        assert_eq!(bookmark(KeyCode::Digit3, false), Some(Action::GoToBookmark(3)));
        assert_eq!(bookmark(KeyCode::Digit9, true), Some(Action::SetBookmark(9)));
        assert_eq!(bookmark(KeyCode::Digit0, false), None);
    }

    #[test]
    fn two_keys_show_help() {
        assert_eq!(action_of_code(KeyCode::KeyH), Some(Action::ToggleHelp));
        assert_eq!(action_of_code(KeyCode::F1), Some(Action::ToggleHelp));
    }
}
