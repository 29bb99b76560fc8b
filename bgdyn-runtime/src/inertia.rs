//! Inertia helpers.
