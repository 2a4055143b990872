//! The shaders in use on one device, and hot reload of their files from a folder.
//!
//! [`Shader::module`](super::shader::Shader::module) registers each shader that it compiles. If a folder is set,
//! shaders are read from the files there. [`ShaderLibrary::reload`] reads all of them again, and replaces their text
//! only if all are valid, so an invalid file does not stop the drawing. The caller then creates its pipelines again.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::shader::Shader;
use super::stitched::Stitched;

/// The shaders in use on one device.
#[derive(Default)]
pub struct ShaderLibrary {
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    folder: Option<PathBuf>,
    in_use: Vec<InUse>,
}

struct InUse {
    shader: Shader,
    /// The text in use.
    text: String,
}

impl ShaderLibrary {
    /// Reads shaders from the files in `folder` from now on. Those already in use are read at the next
    /// [`Self::reload`].
    pub fn read_from(&self, folder: PathBuf) {
        self.state().folder = Some(folder);
    }

    /// Returns the text of a shader, and registers the shader as in use.
    ///
    /// The text is the built-in one if there is no folder, or if the files there are missing or invalid; the log has
    /// the reason.
    pub(super) fn text_of(&self, shader: Shader) -> String {
        let mut state = self.state();
        if let Some(known) = state.in_use.iter().find(|known| known.shader.is(&shader)) {
            return known.text.clone();
        }
        let in_folder = state.folder.as_deref().map(|folder| read(folder, shader));
        let text = match in_folder {
            Some(Ok(text)) => text,
            Some(Err(message)) => {
                log::warn!("the built-in shader is used: {message}");
                shader.source()
            }
            None => shader.source(),
        };
        state.in_use.push(InUse { shader, text: text.clone() });
        text
    }

    /// Reads the files of all shaders in use again. Returns true if a text has changed; existing pipelines still use
    /// the old text.
    ///
    /// # Errors
    /// Returns the message of the first file that is missing or invalid; all texts then stay unchanged.
    pub fn reload(&self) -> Result<bool, String> {
        let mut state = self.state();
        let Some(folder) = state.folder.clone() else { return Ok(false) };
        let texts: Result<Vec<String>, String> = state.in_use.iter().map(|known| read(&folder, known.shader)).collect();
        let mut has_changed = false;
        for (known, text) in state.in_use.iter_mut().zip(texts?) {
            has_changed |= known.text != text;
            known.text = text;
        }
        Ok(has_changed)
    }

    /// Returns the locked state. Its lock can be used after a panic, because no panic leaves the state half changed.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the valid text of a shader whose files lie in `folder`.
fn read(folder: &Path, shader: Shader) -> Result<String, String> {
    let read_part = |&(file, _): &(&'static str, &str)| {
        let text = std::fs::read_to_string(folder.join(file)).map_err(|error| format!("{file}: {error}"))?;
        Ok((file, text))
    };
    let stitched = Stitched { parts: shader.parts.iter().map(read_part).collect::<Result<_, String>>()? };
    let text = stitched.text();
    // The built-in text was validated by a test.
    if text != shader.source() {
        stitched.check()?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHADER: Shader =
        Shader { name: "test", parts: &[("a.wgsl", "const A: f32 = 1.0;\n"), ("b.wgsl", "const B: f32 = A;\n")] };
    const OTHER: Shader = Shader { name: "other", parts: &[("a.wgsl", "const A: f32 = 1.0;\n")] };

    /// Returns a library that reads from a folder with the files of [`SHADER`], and that folder.
    fn library() -> (ShaderLibrary, tempfile::TempDir) {
        let folder = tempfile::tempdir().expect("a folder");
        for (file, text) in SHADER.parts {
            write(&folder, file, text);
        }
        let library = ShaderLibrary::default();
        library.read_from(folder.path().to_owned());
        (library, folder)
    }

    fn write(folder: &tempfile::TempDir, file: &str, text: &str) {
        std::fs::write(folder.path().join(file), text).expect("written");
    }

    #[test]
    fn without_a_folder_the_text_is_built_in() {
        let library = ShaderLibrary::default();
        assert_eq!(library.text_of(SHADER), SHADER.source());
        assert_eq!(library.reload(), Ok(false));
    }

    #[test]
    fn a_changed_file_changes_all_shaders_that_contain_it() {
        let (library, folder) = library();
        assert_eq!([SHADER, OTHER].map(|shader| library.text_of(shader)), [SHADER.source(), OTHER.source()]);
        assert_eq!(library.reload(), Ok(false), "nothing was written");
        write(&folder, "a.wgsl", "const A: f32 = 2.0;\n");
        assert_eq!(library.reload(), Ok(true));
        assert!([SHADER, OTHER].iter().all(|&shader| library.text_of(shader).contains("A: f32 = 2.0")));
    }

    #[test]
    fn a_broken_file_is_reported_and_not_used_until_it_is_mended() {
        let (library, folder) = library();
        assert_eq!([SHADER, OTHER].map(|shader| library.text_of(shader)), [SHADER.source(), OTHER.source()]);
        write(&folder, "a.wgsl", "const A: f32 = 2.0;\n");
        write(&folder, "b.wgsl", "\nconst B: f32 = C;\n");
        let message = library.reload().expect_err("C is unknown");
        assert!(message.starts_with("b.wgsl:2:16:"), "{message}");
        assert_eq!([SHADER, OTHER].map(|shader| library.text_of(shader)), [SHADER.source(), OTHER.source()]);
        write(&folder, "b.wgsl", "const B: f32 = 3.0 * A;\n");
        assert_eq!(library.reload(), Ok(true));
        assert_eq!(library.text_of(SHADER), "const A: f32 = 2.0;\n\nconst B: f32 = 3.0 * A;\n");
    }

    #[test]
    fn an_invalid_file_of_a_new_shader_is_replaced_by_the_built_in_text() {
        let (library, folder) = library();
        write(&folder, "b.wgsl", "no WGSL");
        assert_eq!(library.text_of(SHADER), SHADER.source());
        std::fs::remove_file(folder.path().join("b.wgsl")).expect("removed");
        assert!(library.reload().is_err_and(|message| message.starts_with("b.wgsl: ")));
    }
}
