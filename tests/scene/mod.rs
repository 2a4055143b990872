//! Scenes: reading glTF, the scenes that ship with the program.

mod assets;
mod builtin;
mod loader;
mod twins;
