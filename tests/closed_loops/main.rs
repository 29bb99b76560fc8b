//! Mechanisms with loops in compiled code, in every scalar: closing, integration, laws, motions, errors.

mod balls;
mod closing;
mod laws;
mod motions;
mod reach;
mod scenes;

bgdyn::bgdyn!("../../specs/loops/five_bar.yaml", derivatives = true);
bgdyn::bgdyn!("../../specs/loops/slider_crank.yaml");
bgdyn::bgdyn!("../../specs/loops/slider_crank_near_singular.yaml");
bgdyn::bgdyn!("../../specs/loops/delta_robot.yaml");
bgdyn::bgdyn!(
    "../../specs/loops/spatial_slider_crank.yaml",
    methods = [
        dynamics,
        tree_velocity,
        closing_step,
        constraint_residual,
        joint_reactions,
        assemble
    ]
);
bgdyn::bgdyn!("excavator_bucket.yaml");
bgdyn::bgdyn!("held_table.yaml");
bgdyn::bgdyn!("linkages.yaml");
bgdyn::bgdyn!("planar_rod.yaml");
bgdyn::bgdyn!("short_rod.yaml", module = test_rod);
bgdyn::bgdyn!("short_strut.yaml");
bgdyn::bgdyn!("spatial_run.scene.yaml");
bgdyn::bgdyn!("andrews_run.scene.yaml");
bgdyn::bgdyn!("crank_run.scene.yaml");
bgdyn::bgdyn!("five_bar_run.scene.yaml");
bgdyn::bgdyn!("stewart_run.scene.yaml");
bgdyn::bgdyn!("slider_stop.scene.yaml");
bgdyn::bgdyn!("short_rod.scene.yaml");
bgdyn::bgdyn!("swing.scene.yaml");
