//! Writes files that appear under their final name only when they are complete.

use std::fs;
use std::io::{self, Write as _};
use std::path::Path;

/// Writes a file under a temporary name in the same folder and then renames it. A run that stops early leaves no
/// partial file.
///
/// If `path` names something that is not an ordinary file, such as `/dev/null` or a pipe, the bytes are written to it
/// directly.
///
/// # Errors
/// Returns an error if the folder or the file cannot be written to.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return fs::write(path, bytes);
    }
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // New files get the permissions that the user's mask allows; those of temporary files would be private.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_no_temporary_file_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("light.bin");
        for bytes in [&b"first and longer"[..], b"second"] {
            write_whole(&path, bytes).expect("written");
            assert_eq!(fs::read(&path).expect("read"), bytes);
        }
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_has_the_usual_permissions() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().expect("a folder");
        let (ours, usual) = (folder.path().join("ours"), folder.path().join("usual"));
        write_whole(&ours, b"").expect("written");
        fs::write(&usual, b"").expect("written");
        let [ours, usual] = [ours, usual].map(|path| fs::metadata(path).expect("there").permissions().mode());
        assert_eq!(ours, usual);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_file_is_written_to_and_not_replaced() {
        let device = Path::new("/dev/null");
        write_whole(device, b"gone").expect("written");
        assert!(!fs::metadata(device).expect("there").is_file());
    }

    #[test]
    fn a_missing_folder_is_an_error() {
        assert!(write_whole(Path::new("no/such/folder/file"), b"").is_err());
    }
}
