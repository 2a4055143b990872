//! Threads that work behind the window: whenever a frame wants a processor, they give it up.

use thread_priority::ThreadPriority;

/// The calling thread, and threads that it will start, give way to all others.
pub fn give_way() {
    if let Err(error) = ThreadPriority::Min.set_for_current() {
        log::debug!("a thread keeps its priority: {error:?}");
    }
}

/// The threads that share heavy work give way too; only the first call of a process decides.
pub fn share_work_in_background() {
    if let Err(error) = rayon::ThreadPoolBuilder::new().start_handler(|_| give_way()).build_global() {
        log::debug!("shared work keeps its priority: {error}");
    }
}
