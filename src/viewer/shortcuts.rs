//! Which key does what, besides moving.
//!
//! Letters are taken by their place on the keyboard, like the keys that move; signs by what is printed on them.

use winit::event::KeyEvent;
use winit::keyboard::{Key, KeyCode, PhysicalKey};

use super::panels::Command;

/// What a key press asks for.
#[must_use]
pub fn command_of(event: &KeyEvent) -> Option<Command> {
    if let Key::Character(sign) = &event.logical_key {
        match sign.as_str() {
            "+" | "=" => return Some(Command::StepExposure(1.0)),
            "-" => return Some(Command::StepExposure(-1.0)),
            _ => {}
        }
    }
    match event.physical_key {
        PhysicalKey::Code(code) if !event.repeat => command_of_code(code),
        _ => None,
    }
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
        KeyCode::Digit1 => Command::ToggleDirect,
        KeyCode::Digit2 => Command::ToggleIndirect,
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
    fn help_answers_to_both_of_its_keys() {
        assert_eq!(command_of_code(KeyCode::KeyH), Some(Command::ToggleHelp));
        assert_eq!(command_of_code(KeyCode::F1), Some(Command::ToggleHelp));
    }
}
