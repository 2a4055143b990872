//! Background threads. They have the lowest priority, so that frames are drawn first.

use thread_priority::ThreadPriority;

/// Sets the lowest priority for the calling thread and those that it starts.
pub fn lower_priority() {
    if let Err(error) = ThreadPriority::Min.set_for_current() {
        log::debug!("a thread keeps its priority: {error:?}");
    }
}

/// Sets the lowest priority for the threads of rayon. Has no effect if rayon has started already.
pub fn lower_priority_of_rayon() {
    if let Err(error) = rayon::ThreadPoolBuilder::new().start_handler(|_| lower_priority()).build_global() {
        log::debug!("the threads of rayon keep their priority: {error}");
    }
}
