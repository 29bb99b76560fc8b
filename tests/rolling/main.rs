//! Mechanisms with wheels and knife edges in compiled code, in every scalar: integration, laws, motions, errors.

mod evaluated;
mod laws;
mod motions;
mod scenes;
mod touching;

bgdyn::bgdyn!("../../specs/constraints/chaplygin_sleigh.yaml");
bgdyn::bgdyn!("../../specs/constraints/differential_drive.yaml");
bgdyn::bgdyn!(
    "../../specs/constraints/snakeboard.yaml",
    derivatives = true
);
bgdyn::bgdyn!(
    "../../specs/constraints/rolling_disc.yaml",
    derivatives = true
);
bgdyn::bgdyn!("../../specs/constraints/whipple_bicycle.yaml");
bgdyn::bgdyn!("robot.yaml");
bgdyn::bgdyn!("sleigh_run.scene.yaml");
bgdyn::bgdyn!("robot_run.scene.yaml");
bgdyn::bgdyn!("snakeboard_run.scene.yaml");
bgdyn::bgdyn!("bicycle_run.scene.yaml");
bgdyn::bgdyn!("effects.scene.yaml");
