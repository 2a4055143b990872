//! Which key does what, besides moving.
//!
//! Letters are taken by their place on the keyboard, like the keys that move; signs by what is printed on them.

use winit::event::KeyEvent;
use winit::keyboard::{Key, KeyCode, PhysicalKey};

use super::panels::{Command, Tool};

/// What a key press asks for.
#[must_use]
pub fn command_of(event: &KeyEvent, is_control_down: bool) -> Option<Command> {
    if let Key::Character(sign) = &event.logical_key {
        match sign.as_str() {
            "+" | "=" => return Some(Command::StepExposure(1.0)),
            "-" => return Some(Command::StepExposure(-1.0)),
            _ => {}
        }
    }
    match event.physical_key {
        PhysicalKey::Code(code) if !event.repeat => {
            bookmark(code, is_control_down).or_else(|| if is_control_down { None } else { command_of_code(code) })
        }
        _ => None,
    }
}

/// Number keys go to bookmarks, and set them with control.
fn bookmark(code: KeyCode, is_control_down: bool) -> Option<Command> {
    use KeyCode::*;
    let digits = [Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9];
    let number = 1 + digits.iter().position(|&digit| digit == code)? as u8;
    Some(if is_control_down { Command::Bookmark(number) } else { Command::Recall(number) })
}

fn command_of_code(code: KeyCode) -> Option<Command> {
    Some(match code {
        KeyCode::KeyH | KeyCode::F1 => Command::ToggleHelp,
        KeyCode::KeyP => Command::TogglePanels,
        KeyCode::F11 => Command::ToggleFullScreen,
        KeyCode::F12 => Command::Screenshot,
        KeyCode::KeyF => Command::ToggleWalking,
        KeyCode::Home => Command::FrameAll,
        KeyCode::PageUp => Command::StepCamera(-1),
        KeyCode::PageDown => Command::StepCamera(1),
        KeyCode::KeyX => Command::ToggleAutoExposure,
        KeyCode::KeyT => Command::NextToneMap,
        KeyCode::KeyV => Command::NextShading,
        KeyCode::KeyJ => Command::ToggleDirect,
        KeyCode::KeyK => Command::ToggleIndirect,
        KeyCode::KeyR => Command::ToggleStills,
        KeyCode::KeyM => Command::Take(Tool::Meter),
        KeyCode::KeyG => Command::Take(Tool::Grid),
        KeyCode::KeyN => Command::Take(Tool::Sight),
        KeyCode::KeyL => Command::Take(Tool::Choose),
        KeyCode::Enter => Command::Pin,
        KeyCode::KeyO => Command::ChooseFile,
        KeyCode::F5 => Command::Reload,
        KeyCode::KeyB => Command::ToggleBake,
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
            assert_eq!(command_of_code(code), None, "{code:?}");
        }
    }

    #[test]
    fn number_keys_go_to_bookmarks_and_set_them_with_control() {
        assert_eq!(bookmark(KeyCode::Digit3, false), Some(Command::Recall(3)));
        assert_eq!(bookmark(KeyCode::Digit9, true), Some(Command::Bookmark(9)));
        assert_eq!(bookmark(KeyCode::Digit0, false), None);
    }

    #[test]
    fn help_answers_to_both_of_its_keys() {
        assert_eq!(command_of_code(KeyCode::KeyH), Some(Command::ToggleHelp));
        assert_eq!(command_of_code(KeyCode::F1), Some(Command::ToggleHelp));
    }
}
