//! The model of a camera head, as `docs/first_model.md` builds it.
#![forbid(unsafe_code)]

bgdyn::bgdyn!("head.yaml"); // pub mod head { … }

/// The pages' examples, compiled and run by `cargo test --doc -p camera_head`.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../../docs/first_model.md")]
    struct FirstModel;

    #[doc = include_str!("../../../docs/tests_to_copy.md")]
    struct TestsToCopy;
}
