//! Which key does what, besides moving.
//!
//! Letters are taken by their place on the keyboard, like the keys that move; signs by what is printed on them.

use winit::event::KeyEvent;
use winit::keyboard::{Key, KeyCode, PhysicalKey};

use super::panels::{Action, Tool};

/// What a key press asks for.
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

/// Number keys go to bookmarks, and set them with control.
fn bookmark(code: KeyCode, is_control_down: bool) -> Option<Action> {
    use KeyCode::*;
    let digits = [Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9];
    let number = 1 + digits.iter().position(|&digit| digit == code)? as u8;
    Some(if is_control_down { Action::Bookmark(number) } else { Action::Recall(number) })
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
        KeyCode::KeyM => Action::Take(Tool::Meter),
        KeyCode::KeyG => Action::Take(Tool::Grid),
        KeyCode::KeyN => Action::Take(Tool::PatchView),
        KeyCode::KeyL => Action::Take(Tool::Choose),
        KeyCode::Enter => Action::Pin,
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
    fn keys_that_move_are_no_shortcuts() {
        use KeyCode::*;
        for code in [KeyW, KeyA, KeyS, KeyD, KeyQ, KeyE, KeyC, Space, ShiftLeft, ArrowLeft, ArrowUp] {
            assert_eq!(action_of_code(code), None, "{code:?}");
        }
    }

    #[test]
    fn number_keys_go_to_bookmarks_and_set_them_with_control() {
        assert_eq!(bookmark(KeyCode::Digit3, false), Some(Action::Recall(3)));
        assert_eq!(bookmark(KeyCode::Digit9, true), Some(Action::Bookmark(9)));
        assert_eq!(bookmark(KeyCode::Digit0, false), None);
    }

    #[test]
    fn help_answers_to_both_of_its_keys() {
        assert_eq!(action_of_code(KeyCode::KeyH), Some(Action::ToggleHelp));
        assert_eq!(action_of_code(KeyCode::F1), Some(Action::ToggleHelp));
    }
}
