"""What a user may write: a type checker accepts all lines but those that say what it reports."""

import numpy as np
from numpy.typing import NDArray
from typing_extensions import assert_type

import bgdyn

Array = NDArray[np.float64]

arm = bgdyn.load("scara.yaml", prefer="accuracy", parameters={"payload": 1.0})
q: Array = np.zeros((10, 4))
assert_type(arm.inverse_dynamics(q, q, q, threads=2), Array)
assert_type(arm.forward_dynamics(q, q, q), Array)
assert_type(arm.forward_dynamics(q, q, q, on_singular="nan"), tuple[Array, NDArray[np.bool_]])
assert_type(arm.inverse_dynamics_derivatives(q, q, q).v, Array)
assert_type(arm.gravity([0.0, 0.1, 0.2, 0.3]), Array)
assert_type(arm.joint_names, tuple[str, ...])
assert_type(arm.pose_tool, bgdyn.Method)
assert_type(arm.mass_matrix(q, on_singular="nan"), tuple[Array, NDArray[np.bool_]])
assert_type(arm.mass_matrix.units, str)
method: bgdyn.Method = arm.joint_reactions
assert_type(arm.joint_reactions(q, q, q), bgdyn.Wrenches)
assert_type(arm.constraint_bias(q, qd=q), Array)
room = np.zeros((10, 4, 4))
assert_type(arm.inverse_dynamics_derivatives(q, q, q, out=(room, room.copy())), bgdyn.InverseDerivatives)
pose: bgdyn.Pose = arm.pose_tool(q)
assert_type(pose.translation, Array)
assert_type(arm.with_parameters(payload=2.0), bgdyn.Model)

assert_type(arm.integrate(q, q), Array)
assert_type(arm.close(q, on_singular="nan"), tuple[Array, NDArray[np.bool_]])
assert_type(arm.sample((2, 3), seed=1), Array)
assert_type(arm.sample(2, on_singular="nan"), tuple[Array, NDArray[np.bool_]])
assert_type(arm.link_names, tuple[str, ...])
assert_type(bgdyn.__version__, str)
assert_type(arm.source("gravity"), str)
assert_type(arm.source(bundles={"control": ["mass_matrix", "bias"]}, backend="c"), dict[str, str])

swept = bgdyn.Scene("arm.scene.yaml").sweep({"payload": [1.0, 2.0]}, workers=2, progress=lambda done, total: None)
assert_type(swept.end["shoulder"], Array)
assert_type(swept.failures, dict[int, str])
bgdyn.Scene("arm.scene.yaml").sweep({"payload": 1.0, "shoulder": [0.0, 1.0]})

run = bgdyn.Scene("arm.scene.yaml").simulate(duration=2.0, parameters={"payload": 2.0})
assert_type(run["shoulder"], Array)
assert_type(run.balance["links"].stored, float)
assert_type(run.events[0].t, float)
assert_type(run.failure, str | None)

try:
    arm.forward_dynamics(q, q, q)
except bgdyn.SingularError as error:
    assert_type(error.index, tuple[int, ...])
    assert_type(error.joint, str | None)

single = np.zeros(4, dtype=np.float32)
arm.gravity(single)  # mistake: arg-type
arm.gravity(q, q)  # mistake: call-overload
arm.gravity("zero")  # mistake: arg-type
arm.forward_dynamics(q, q, q, on_singular="ignore")  # mistake: call-overload
arm.sample("ten")  # mistake: call-overload
arm.nq = 5  # mistake: misc
arm.source(options={"plain": True})  # mistake: dict-item
bgdyn.load(text=5)  # mistake: arg-type
run.end  # mistake: attr-defined
