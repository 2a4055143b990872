//! What the device does for software rendering alone; `viewer::software` says what else there is.

/// Keeps the allocator from returning a software driver's memory to the system after every submission, only to request it
/// again: that took a third of the time of a hemicube (Mesa 22.3, lavapipe, glibc 2.36).
///
/// The GNU allocator keeps up to twice the size of the largest block that it has freed, for blocks of up to 32 MiB
/// (mallopt(3), `M_MMAP_THRESHOLD`). This block is allocated and freed but never touched, so it costs no memory. Other
/// allocators just free it.
pub(super) fn keep_allocated_memory() {
    const LARGEST: usize = 31 << 20;
    drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGEST)));
}
