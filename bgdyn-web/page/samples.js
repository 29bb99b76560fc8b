// The samples: mechanisms and scenes of `specs/`.
import cartPole from "../../specs/cart_pole.yaml";
import cartAndPole from "../../specs/scenes/cart_and_pole.scene.yaml";
import crane from "../../specs/crane.yaml";
import craneScene from "../../specs/scenes/crane.scene.yaml";
import cylinder from "../../specs/cylinder.yaml";
import hydraulic from "../../specs/scenes/hydraulic_cylinder.scene.yaml";
import differentialDrive from "../../specs/constraints/differential_drive.yaml";
import doublePendulum from "../../specs/double_pendulum.yaml";
import elasticArm from "../../specs/elastic_arm.yaml";
import seriesElastic from "../../specs/scenes/series_elastic_arm.scene.yaml";
import fourBar from "../../specs/loops/four_bar.yaml";
import puma from "../../specs/puma560.yaml";
import pumaDrives from "../../specs/scenes/puma_drives.scene.yaml";
import scara from "../../specs/scara.yaml";
import scaraEverything from "../../specs/scenes/scara_everything.scene.yaml";
import slider from "../../specs/slider.yaml";
import stickSlip from "../../specs/scenes/stick_slip.scene.yaml";
import ur5 from "../../specs/ur5.yaml";
import ur5Contact from "../../specs/scenes/ur5_contact.scene.yaml";

const file = (name, text) => ({ name, text });
const sample = (title, mechanism, scene) => ({ title, mechanism, scene: scene ?? file("", "") });

export const SAMPLES = [
  sample("Cart and pole", file("cart_pole.yaml", cartPole), file("cart_and_pole.scene.yaml", cartAndPole)),
  sample("Block on a belt: stick and slip", file("slider.yaml", slider), file("stick_slip.scene.yaml", stickSlip)),
  sample("Crane", file("crane.yaml", crane), file("crane.scene.yaml", craneScene)),
  sample("Hydraulic cylinder", file("cylinder.yaml", cylinder), file("hydraulic_cylinder.scene.yaml", hydraulic)),
  sample("Arm with elastic joints", file("elastic_arm.yaml", elasticArm), file("series_elastic_arm.scene.yaml", seriesElastic)),
  sample("SCARA: drives, friction, payload", file("scara.yaml", scara), file("scara_everything.scene.yaml", scaraEverything)),
  sample("UR5 in contact", file("ur5.yaml", ur5), file("ur5_contact.scene.yaml", ur5Contact)),
  sample("PUMA 560 with drives", file("puma560.yaml", puma), file("puma_drives.scene.yaml", pumaDrives)),
  sample("Double pendulum, without a scene", file("double_pendulum.yaml", doublePendulum)),
  sample("Four-bar linkage, without a scene", file("four_bar.yaml", fourBar)),
  sample("Differential drive, without a scene", file("differential_drive.yaml", differentialDrive)),
];

/** Returns the text of a first scene of a mechanism. */
export const firstScene = (mechanism) => `# What acts in the run, how it starts, how it is integrated.
scene: 1
mechanism: ${mechanism}

effects: [gravity, inertia, velocity_products]
integration: { method: rk4, step: 1 ms, end: 5 s }
`;
