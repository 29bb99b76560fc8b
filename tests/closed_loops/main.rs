//! Mechanisms with loops in compiled code, in every scalar: closing, integration, laws, motions, errors.

mod laws;
mod motions;
mod reach;

bgdyn::bgdyn!("../../specs/loops/five_bar.yaml", derivatives = true);
bgdyn::bgdyn!("../../specs/loops/slider_crank.yaml");
bgdyn::bgdyn!("../../specs/loops/slider_crank_near_singular.yaml");
bgdyn::bgdyn!("../../specs/loops/delta_robot.yaml");
bgdyn::bgdyn!("excavator_bucket.yaml");
