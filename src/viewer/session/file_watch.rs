//! Watches the open file, so that the scene is loaded again after another program has written it.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use winit::event_loop::EventLoopProxy;

use crate::viewer::session::user_event::UserEvent;

/// Time between two checks of the file; a file that is the same in two checks is complete.
const INTERVAL: Duration = Duration::from_millis(700);

/// Time of modification and size of a file.
type Stamp = (SystemTime, u64);

/// A thread that watches a file until it is dropped.
pub struct FileWatch {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl FileWatch {
    /// Watches `path`; `None` if the system cannot start a thread.
    #[must_use]
    pub fn start(path: PathBuf, window: EventLoopProxy<UserEvent>) -> Option<Self> {
        let on_change = move || {
            // The event loop is gone once the window is closed.
            let _ = window.send_event(UserEvent::FileChanged);
        };
        Self::with(path, INTERVAL, Arc::new(on_change))
    }

    fn with(path: PathBuf, interval: Duration, on_change: Arc<dyn Fn() + Send + Sync>) -> Option<Self> {
        let (stop, stopped) = mpsc::channel();
        let watch = move || {
            let mut known = stamp(&path);
            let mut last = known;
            while stopped.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                let now = stamp(&path);
                // A file that is still being written differs from check to check.
                if now.is_some() && now != known && now == last {
                    known = now;
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

fn stamp(path: &PathBuf) -> Option<Stamp> {
    let found = std::fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
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
}
