//! The allocator of tests that generate much: with that of glibc they take a fifth longer.

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;
