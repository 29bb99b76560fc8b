//! Rotation helpers.
