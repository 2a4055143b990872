//! Watches the open file: when another program has written it, the scene is read again.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use winit::event_loop::EventLoopProxy;

use super::worker::{Event, News};

/// The file is looked at this often; it counts as written when it has stayed the same for as long.
const INTERVAL: Duration = Duration::from_millis(700);

/// Time and size of a file: what a new version differs in.
type Stamp = (SystemTime, u64);

/// A thread that watches a file until it is dropped.
pub struct FileWatch {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl FileWatch {
    /// Watches `path` for the scene of a job; none where the system gives no thread.
    #[must_use]
    pub fn start(path: PathBuf, job: u32, window: EventLoopProxy<News>) -> Option<Self> {
        let tell = move || {
            // Nobody listens once the window is closed.
            let _ = window.send_event(News { job, event: Event::FileChanged });
        };
        Self::with(path, INTERVAL, Arc::new(tell))
    }

    fn with(path: PathBuf, interval: Duration, tell: Arc<dyn Fn() + Send + Sync>) -> Option<Self> {
        let (stop, stopped) = mpsc::channel();
        let watch = move || {
            let mut known = stamp(&path);
            let mut last = known;
            while stopped.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                let now = stamp(&path);
                // A file that is still being written changes from look to look.
                if now.is_some() && now != known && now == last {
                    known = now;
                    tell();
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
            // It has nothing to panic about.
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
    fn a_new_version_is_told_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("hall.glb");
        std::fs::write(&path, "old").expect("written");
        let (told, heard) = mpsc::channel();
        let tell = Arc::new(move || told.send(()).expect("somebody listens"));
        let watch = FileWatch::with(path.clone(), Duration::from_millis(10), tell).expect("a thread");
        assert!(heard.recv_timeout(Duration::from_millis(60)).is_err(), "nothing was written");
        std::fs::write(&path, "a new version").expect("written");
        assert!(heard.recv_timeout(Duration::from_secs(5)).is_ok());
        assert!(heard.recv_timeout(Duration::from_millis(60)).is_err(), "it was told twice");
        drop(watch);
    }
}
