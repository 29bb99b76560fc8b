//! The models, with the data that the tests need about each.

macro_rules! robots {
    ($($path:literal, $module:ident, $model:ident, $n:literal;)*) => {
        $(bgdyn::bgdyn!($path);)*

        /// Runs a check, generic over the model, for every robot.
        macro_rules! for_each_robot {
            ($check:ident) => {
                $($check::<_, $n>(stringify!($module), &crate::robots::$module::$model::default(), &crate::robots::$module::JOINT_NAMES);)*
            };
        }
        pub(crate) use for_each_robot;

        /// Runs a check of the operations that each robot's module states.
        macro_rules! for_each_operations {
            ($check:ident) => {
                $($check::<_, $n>(stringify!($module), &crate::robots::$module::$model::default(), &crate::robots::$module::OPERATIONS);)*
            };
        }
        pub(crate) use for_each_operations;
    };
}

robots! {
    "../golden/specs/scara4.yaml", scara4, Scara4, 4;
    "../golden/specs/puma560.yaml", puma560, Puma560, 6;
    "../golden/specs/panda7.yaml", panda7, Panda7, 7;
    "../golden/specs/dpend2.yaml", dpend2, Dpend2, 2;
    "../golden/specs/chain4.yaml", chain4, Chain4, 4;
    "../golden/specs/chain8.yaml", chain8, Chain8, 8;
    "../golden/specs/scara_rrpr.yaml", scara_rrpr, ScaraRrpr, 4;
    "../golden/specs/stanford_gen.yaml", stanford_gen, StanfordGen, 6;
    "../golden/specs/puma_gen.yaml", puma_gen, PumaGen, 6;
    "../golden/specs/puma_arm.yaml", puma_arm, PumaArm, 6;
    "../golden/specs/ur5_gen.yaml", ur5_gen, Ur5Gen, 6;
    "../golden/specs/panda_gen.yaml", panda_gen, PandaGen, 7;
    "../golden/specs/iiwa_gen.yaml", iiwa_gen, IiwaGen, 7;
}
