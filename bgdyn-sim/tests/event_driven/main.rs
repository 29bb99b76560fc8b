//! Rigid contacts from event to event, compared with closed forms.

#[path = "planar.rs"]
mod bodies;
mod corners;
#[path = "../moreau/sphere.rs"]
mod sphere;
mod spheres;
