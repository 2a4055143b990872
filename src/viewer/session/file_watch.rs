//! Watches a file, or the shaders in a folder, for changes by another program. After a change the scene or the shaders
//! are loaded again.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use winit::event_loop::EventLoopProxy;

use crate::viewer::session::user_event::UserEvent;

/// Time between two checks. A file that is the same in two checks counts as completely written.
const INTERVAL: Duration = Duration::from_millis(700);

/// Time of modification and size of each watched file.
type Stamp = Vec<(PathBuf, SystemTime, u64)>;

/// A thread that watches a file or a folder until it is dropped.
pub struct FileWatch {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl FileWatch {
    /// Watches `path`, a file or a folder of shaders, and sends `event` after each change. Returns `None` if the system
    /// cannot start a thread.
    #[must_use]
    pub fn start(path: PathBuf, window: EventLoopProxy<UserEvent>, event: fn() -> UserEvent) -> Option<Self> {
        let on_change = move || {
            // The event loop is gone once the window is closed.
            let _ = window.send_event(event());
        };
        Self::with(path, INTERVAL, Arc::new(on_change))
    }

    fn with(path: PathBuf, interval: Duration, on_change: Arc<dyn Fn() + Send + Sync>) -> Option<Self> {
        let (stop, stopped) = mpsc::channel();
        let watch = move || {
            let mut known = stamp(&path);
            let mut last = known.clone();
            while stopped.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                let now = stamp(&path);
                // A file that is still being written differs from check to check.
                if !now.is_empty() && now != known && now == last {
                    known.clone_from(&now);
                    on_change();
                }
                last = now;
            }
        };
        let thread = std::thread::Builder::new().name("watch".to_owned()).spawn(watch).ok()?;
        Some(Self { stop: Some(stop), thread: Some(thread) })
    }
}

impl Drop for FileWatch {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            // The thread cannot panic.
            let _ = thread.join();
        }
    }
}

/// Reads the stamp of a file, or of all `.wgsl` files below a folder; empty if there is none.
fn stamp(path: &Path) -> Stamp {
    let entries = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let Ok(found) = std::fs::metadata(path) else { return Stamp::new() };
    if found.is_dir() {
        let is_watched =
            |path: &PathBuf| path.is_dir() || path.extension().is_some_and(|extension| extension == "wgsl");
        let mut stamps: Stamp = entries(path).filter(is_watched).flat_map(|path| stamp(&path)).collect();
        stamps.sort();
        return stamps;
    }
    found.modified().map_or_else(|_| Stamp::new(), |modified| vec![(path.to_owned(), modified, found.len())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_version_is_reported_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("hall.glb");
        std::fs::write(&path, "old").expect("written");
        let (sender, receiver) = mpsc::channel();
        let on_change = Arc::new(move || sender.send(()).expect("the test waits"));
        let watch = FileWatch::with(path.clone(), Duration::from_millis(10), on_change).expect("a thread");
        assert!(receiver.recv_timeout(Duration::from_millis(60)).is_err(), "nothing was written");
        std::fs::write(&path, "a new version").expect("written");
        assert!(receiver.recv_timeout(Duration::from_secs(5)).is_ok());
        assert!(receiver.recv_timeout(Duration::from_millis(60)).is_err(), "it was reported twice");
        drop(watch);
    }

    #[test]
    fn a_new_version_of_a_shader_in_a_folder_is_reported() {
        let folder = tempfile::tempdir().expect("a folder");
        let shader = folder.path().join("surface").join("pass.wgsl");
        std::fs::create_dir(folder.path().join("surface")).expect("made");
        std::fs::write(&shader, "old").expect("written");
        let before = stamp(folder.path());
        std::fs::write(folder.path().join("notes.txt"), "no shader").expect("written");
        assert_eq!(stamp(folder.path()), before);
        std::fs::write(&shader, "a new version").expect("written");
        assert_ne!(stamp(folder.path()), before);
    }
}
