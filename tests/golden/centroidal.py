"""Makes golden/centroidal: centre of mass, momentum about it, and rates, by Pinocchio.

    python centroidal.py [--check]

It needs pin (Pinocchio 4.1), numpy and PyYAML. Robots with a URDF are read from urdf/, others from joints/NAME.yaml
with revolute, spherical and floating joints. Vectors have the angular part first, as everywhere in these files.
--check compares with the files instead of writing them.
"""

import json
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin
import yaml

HERE = Path(__file__).parent
URDFS = ["scara4", "puma560", "panda7"]
SPECS = ["satellite_arm6", "spherical_chain3"]
STATES = 3
# Pinocchio's spatial vectors have the linear part first.
ANGULAR_FIRST = [3, 4, 5, 0, 1, 2]
AXES = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}


def joint_model(joint):
    if joint["type"] == "floating":
        return pin.JointModelFreeFlyer()
    if joint["type"] == "spherical":
        return pin.JointModelSpherical()
    assert joint["type"] == "revolute", joint
    return pin.JointModelRevoluteUnaligned(*map(float, AXES[joint["axis"]]))


def model_of_spec(name):
    """Returns the model of a spec, in which every link has a joint."""
    spec = yaml.safe_load((HERE / "joints" / f"{name}.yaml").read_text())
    model, ids = pin.Model(), {}
    for link in spec["links"]:
        joint = link["joint"]
        origin = joint.get("origin", {})
        place = pin.SE3(
            pin.rpy.rpyToMatrix(np.array(origin.get("rpy", [0, 0, 0]), float)),
            np.array(origin.get("xyz", [0, 0, 0]), float),
        )
        parent = ids.get(link.get("parent"), 0)
        own = model.addJoint(parent, joint_model(joint), place, joint["name"])
        inertia = link["inertia"]
        entry = lambda k: float(inertia.get(k, 0))
        tensor = [[entry("".join(sorted((i, k)))) for k in "xyz"] for i in "xyz"]
        com = np.array(link.get("com", [0, 0, 0]), float)
        body = pin.Inertia(float(link["mass"]), com, np.array(tensor))
        model.appendBodyToJoint(own, body, pin.SE3.Identity())
        ids[link["name"]] = own
    return model


def state(model, data, rng):
    q = pin.integrate(model, pin.neutral(model), rng.uniform(-1.5, 1.5, model.nv))
    v = rng.uniform(-2, 2, model.nv)
    still = np.zeros(model.nv)
    momentum_map = pin.computeCentroidalMap(model, data, q)[ANGULAR_FIRST].copy()
    pin.computeCentroidalMomentumTimeVariation(model, data, q, v, still)
    momentum = data.hg.vector[ANGULAR_FIRST].copy()
    bias = data.dhg.vector[ANGULAR_FIRST].copy()
    centre = pin.centerOfMass(model, data, q).copy()
    jacobian = pin.jacobianCenterOfMass(model, data, q).copy()
    coriolis = pin.computeCoriolisMatrix(model, data, q, v).copy()
    # The rate of the momentum is also that by differences, and the momentum that of the map.
    step = 1e-5
    moved = [
        pin.computeCentroidalMomentum(model, data, pin.integrate(model, q, s * step * v), v)
        .vector[ANGULAR_FIRST]
        .copy()
        for s in (1, -1)
    ]
    size = 1 + np.abs(bias).max()
    assert np.abs((moved[0] - moved[1]) / (2 * step) - bias).max() < 1e-6 * size
    assert np.abs(momentum_map @ v - momentum).max() < 1e-12 * (1 + np.abs(momentum).max())
    return {
        "q": q,
        "v": v,
        "centre_of_mass": centre,
        "com_jacobian": jacobian,
        "centroidal_map": momentum_map,
        "centroidal_momentum": momentum,
        "centroidal_bias": bias,
        "mass_matrix_rate": coriolis + coriolis.T,
    }


def numbers(value):
    return value.tolist() if isinstance(value, np.ndarray) else value


def main():
    check = "--check" in sys.argv
    models = [(n, pin.buildModelFromUrdf(str(HERE / "urdf" / f"{n}.urdf"))) for n in URDFS]
    models += [(n, model_of_spec(n)) for n in SPECS]
    for k, (name, model) in enumerate(models):
        data, rng = model.createData(), np.random.default_rng(40 + k)
        states = [state(model, data, rng) for _ in range(STATES)]
        whole = {
            "made_by": f"golden/centroidal.py, Pinocchio {pin.__version__}",
            "joints": list(model.names)[1:],
            "states": [{key: numbers(x) for key, x in one.items()} for one in states],
        }
        path = HERE / "centroidal" / f"{name}.json"
        if not check:
            path.write_text(json.dumps(whole) + "\n")
            continue
        known = json.loads(path.read_text())
        for old, new in zip(known["states"], whole["states"]):
            for key, value in new.items():
                difference = np.abs(np.array(old[key]) - np.array(value)).max()
                assert difference < 1e-11 * (1 + np.abs(np.array(value)).max()), (name, key)


if __name__ == "__main__":
    main()
