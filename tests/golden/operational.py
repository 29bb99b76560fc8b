"""Makes golden/operational: operational space, derivatives along directions and adjoints, by Pinocchio.

    python operational.py [--check]

It needs what centroidal.py needs. The frame is that of the last link; spatial vectors have the angular part first, axes
are those of the world. --check compares with the files instead of writing them.
"""

import json
import sys

import numpy as np
import pinocchio as pin
import yaml

from centroidal import ANGULAR_FIRST, HERE, model_of_spec, numbers

URDFS = ["puma560", "panda7"]
SPECS = ["satellite_arm6"]
STATES = 3


def state(model, data, rng):
    n = model.nv
    q = pin.integrate(model, pin.neutral(model), rng.uniform(-1.5, 1.5, n))
    v, a, tau, l, dq, dv, da, dtau = (rng.uniform(-2, 2, n) for _ in range(8))
    last = model.njoints - 1
    aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    jacobian = pin.getJointJacobian(model, data, last, aligned)[ANGULAR_FIRST]
    pin.forwardKinematics(model, data, q, v, np.zeros(n))
    drift = pin.getClassicalAcceleration(model, data, last, aligned).vector[ANGULAR_FIRST]
    bias = pin.nonLinearEffects(model, data, q, v).copy()
    inverse = np.linalg.inv(mass)
    task_inverse = jacobian @ inverse @ jacobian.T
    task = np.linalg.inv(task_inverse)
    slopes = [m.copy() for m in pin.computeRNEADerivatives(model, data, q, v, a)]
    by_q, by_v = slopes[0], slopes[1]
    forward = [m.copy() for m in pin.computeABADerivatives(model, data, q, v, tau)]
    return {
        "q": q, "v": v, "a": a, "tau": tau,
        "l": l, "dq": dq, "dv": dv, "da": da, "dtau": dtau,
        "inverse_mass_matrix": inverse,
        "operational_inverse": task_inverse,
        "operational_inertia": task,
        "consistent_inverse": inverse @ jacobian.T @ task,
        "operational_bias": task @ (jacobian @ inverse @ bias - drift),
        "inverse_dynamics_along": by_q @ dq + by_v @ dv + mass @ da,
        "inverse_dynamics_adjoint": np.array([by_q.T @ l, by_v.T @ l, mass @ l]),
        "forward_dynamics_along": forward[0] @ dq + forward[1] @ dv + inverse @ dtau,
        "forward_dynamics_adjoint": np.array([forward[0].T @ l, forward[1].T @ l, inverse @ l]),
    }


def main():
    check = "--check" in sys.argv
    (HERE / "operational").mkdir(exist_ok=True)
    models = [(n, pin.buildModelFromUrdf(str(HERE / "urdf" / f"{n}.urdf"))) for n in URDFS]
    models += [(n, model_of_spec(n)) for n in SPECS]
    for k, (name, model) in enumerate(models):
        spec = HERE / "joints" / f"{name}.yaml"
        if spec.exists():
            model.gravity.linear = np.array(yaml.safe_load(spec.read_text())["gravity"], float)
        data, rng = model.createData(), np.random.default_rng(60 + k)
        states = [state(model, data, rng) for _ in range(STATES)]
        content = {
            "made_by": f"golden/operational.py, Pinocchio {pin.__version__}",
            "states": [{key: numbers(x) for key, x in one.items()} for one in states],
        }
        path = HERE / "operational" / f"{name}.json"
        if check:
            known = json.loads(path.read_text())["states"]
            for old, new in zip(known, states, strict=True):
                for key, value in new.items():
                    assert np.allclose(old[key], value, rtol=1e-9, atol=1e-9), (name, key)
        else:
            path.write_text(json.dumps(content) + "\n")
        print(name, "ok")


if __name__ == "__main__":
    main()
