//! Joints with several degrees of freedom in compiled code, in every scalar: motions keep what they must
//! keep, integration undoes difference, and the laws between the methods hold along the tangent.

mod access;
mod laws;
mod motions;
mod moving_base;
mod prescribed;

bgdyn::bgdyn!("any_length.yaml");
bgdyn::bgdyn!("boom.yaml");
bgdyn::bgdyn!("boom_floating.yaml", frames = [carrier]);
bgdyn::bgdyn!("carousel.yaml", derivatives = true);
bgdyn::bgdyn!("carousel_free.yaml");
bgdyn::bgdyn!("coupled.yaml", derivatives = true);
bgdyn::bgdyn!("helical_universal_test.yaml");
bgdyn::bgdyn!("quadrotor_arm.yaml", derivatives = true);
bgdyn::bgdyn!("satellite_arm6.yaml");
bgdyn::bgdyn!("spherical_chain3.yaml");
