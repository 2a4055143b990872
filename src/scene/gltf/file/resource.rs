//! Reads the bytes of a glTF URI: an embedded `data:` URI, or a file in the scene's folder. No other file is ever
//! opened.

use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;

/// Largest file that is read, bytes.
pub(crate) const MAX_FILE_BYTES: u64 = 4 << 30;

/// Returns the bytes of `uri`, and subtracts their number from the budget `left`. `folder` is the folder of the scene;
/// `None` if the scene was given as bytes.
///
/// # Errors
/// Returns an error if the URI is refused or the file cannot be read. The error is one sentence with the URI, which the
/// caller embeds in its own error or note.
pub(crate) fn fetch(uri: &str, folder: Option<&Path>, left: &mut u64) -> Result<Vec<u8>, String> {
    let bytes = match uri.strip_prefix("data:") {
        Some(data) => decode_data_uri(data)?,
        None => read_beside(uri, folder, *left)?,
    };
    *left = left.saturating_sub(bytes.len() as u64);
    Ok(bytes)
}

fn read_beside(uri: &str, folder: Option<&Path>, left: u64) -> Result<Vec<u8>, String> {
    let relative = relative_path(uri)?;
    let folder = folder.ok_or_else(|| format!("{uri:?} is an external file, but the scene has no folder"))?;
    let path = folder.join(relative);
    if !path.is_file() {
        return Err(format!("the file {uri:?} is missing (it belongs beside the scene)"));
    }
    let failed = |error: std::io::Error| format!("cannot read {uri:?}: {error}");
    // A symbolic link inside the folder may lead out of it.
    if !path.canonicalize().map_err(failed)?.starts_with(folder.canonicalize().map_err(failed)?) {
        return Err(refused(uri));
    }
    if std::fs::metadata(&path).map_err(failed)?.len() > left.min(MAX_FILE_BYTES) {
        return Err(format!("the file {uri:?} is too large, alone or with those before it"));
    }
    std::fs::read(&path).map_err(failed)
}

fn decode_data_uri(data: &str) -> Result<Vec<u8>, String> {
    let (head, payload) = data.split_once(',').ok_or("its data: URI has no comma")?;
    if !head.ends_with(";base64") {
        return Ok(percent_decode_str(payload).collect());
    }
    let lenient = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&base64::alphabet::STANDARD, lenient)
        .decode(payload)
        .map_err(|error| format!("its data: URI is not valid base64: {error}"))
}

/// Returns the relative path in a URI. Refuses paths that could lead out of the scene's folder.
fn relative_path(uri: &str) -> Result<PathBuf, String> {
    let decoded = percent_decode_str(uri).decode_utf8().map_err(|_| format!("{uri:?} is not UTF-8"))?;
    // Colons and backslashes occur in other schemes, drives, and Windows paths.
    if decoded.is_empty() || decoded.contains([':', '\\', '\0']) {
        return Err(refused(uri));
    }
    let path = PathBuf::from(decoded.as_ref());
    let stays_inside = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if stays_inside { Ok(path) } else { Err(refused(uri)) }
}

fn refused(uri: &str) -> String {
    // URIs can have any length, so the message shows only the beginning.
    let shown: String = uri.chars().take(80).collect();
    format!("{shown:?} is refused: only files in the scene's own folder and data: URIs are read")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, String> {
        fetch(uri, folder, &mut u64::MAX.clone())
    }

    #[test]
    fn bytes_read_are_subtracted_from_the_budget() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("a.bin"), b"12345").expect("written");
        let mut left = 8;
        assert!(fetch("a.bin", Some(folder.path()), &mut left).is_ok());
        assert!(fetch("a.bin", Some(folder.path()), &mut left).expect_err("3 are left").contains("too large"));
    }

    #[test]
    fn data_uris_are_decoded_with_and_without_padding() {
        assert_eq!(all("data:application/octet-stream;base64,AQI=", None), Ok(vec![1, 2]));
        assert_eq!(all("data:;base64,AQI", None), Ok(vec![1, 2]));
        assert_eq!(all("data:text/plain,a%20b", None), Ok(b"a b".to_vec()));
        assert!(all("data:;base64,*", None).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_out_of_the_folder_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).expect("made");
        std::fs::write(folder.path().join("secret.bin"), b"secret").expect("written");
        std::os::unix::fs::symlink("../secret.bin", inner.join("link.bin")).expect("linked");
        std::fs::write(inner.join("own.bin"), b"own").expect("written");
        std::os::unix::fs::symlink("own.bin", inner.join("alias.bin")).expect("linked");
        assert!(all("link.bin", Some(&inner)).expect_err("outside").contains("is refused"));
        assert_eq!(all("alias.bin", Some(&inner)), Ok(b"own".to_vec()));
    }

    #[test]
    fn paths_out_of_the_folder_are_refused() {
        for uri in ["../a.bin", "a/../../b", "/etc/passwd", "file:///a", "http://h/a", "C:\\a", "%2e%2e/a", "a%5Cb", ""]
        {
            assert!(relative_path(uri).is_err(), "{uri}");
        }
        assert_eq!(relative_path("./textures/my%20wood.png"), Ok(PathBuf::from("./textures/my wood.png")));
    }
}
