//! Measures of the device for software rendering only; `viewer::software` lists the others.

/// Sets the allocator to keep freed memory. Otherwise a software driver's memory is returned to the system after every
/// submission and requested again, which took a third of the time of a hemicube (Mesa 22.3, lavapipe, glibc 2.36).
///
/// The GNU allocator keeps up to twice the size of the largest block freed so far, for blocks of up to 32 MiB
/// (mallopt(3), `M_MMAP_THRESHOLD`). This function allocates and frees such a block. It never touches the block, so the
/// block costs no memory. Other allocators just free it.
pub(super) fn keep_allocated_memory() {
    const LARGEST: usize = 31 << 20;
    drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGEST)));
}
