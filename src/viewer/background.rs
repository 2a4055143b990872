//! Threads that work in the background, with the lowest priority, so that frames are drawn first.

use thread_priority::ThreadPriority;

/// Gives the calling thread, and those that it starts, the lowest priority.
pub fn lower_priority() {
    if let Err(error) = ThreadPriority::Min.set_for_current() {
        log::debug!("a thread keeps its priority: {error:?}");
    }
}

/// Gives the threads of rayon the lowest priority; without effect if rayon has started already.
pub fn lower_priority_of_rayon() {
    if let Err(error) = rayon::ThreadPoolBuilder::new().start_handler(|_| lower_priority()).build_global() {
        log::debug!("the threads of rayon keep their priority: {error}");
    }
}
