"""The page of results, and the numbers of its figure."""

import datetime
import math
import os
import platform
import sys
from importlib.metadata import version
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))
from machine import output, processor  # noqa: E402

SYSTEMS = ["bgdyn", "MuJoCo", "Pinocchio", "Drake", "rapier"]
TITLES = {"viscous": "Viscous friction", "friction": "Viscous and dry friction"}
# Errors for which systems are compared, rad.
ERRORS = [1e-2, 1e-3, 1e-6, 1e-9]
# Names in the legend, colour and whether points are hollow.
LEGEND = {
    ("bgdyn", "dop853"): ("bgdyn dop853", 0, False),
    ("bgdyn", "rk4"): ("bgdyn rk4", 0, True),
    ("MuJoCo", "RK4"): ("MuJoCo RK4", 2, False),
    ("MuJoCo", "implicitfast"): ("MuJoCo implicit", 2, True),
    ("Pinocchio", "rk4"): ("Pinocchio RK4", 1, False),
    ("Drake", "runge_kutta3"): ("Drake RK3", 3, False),
    ("rapier", "multibody"): ("rapier", 4, False),
}
# In the panel of many states, these have the look of these.
MANY = {
    ("bgdyn", "rk4, 8 lanes"): ("bgdyn", "rk4"),
    ("bgdyn", "rk4, 8 lanes, all cores"): ("bgdyn", "dop853"),
    ("MuJoCo", "RK4, all cores"): ("MuJoCo", "RK4"),
    ("Pinocchio", "rk4, all cores"): ("Pinocchio", "rk4"),
}


def circumstances(root):
    """What is known while measuring: machine, versions, commit."""
    commit = output("git", "-C", str(root), "rev-parse", "--short=8", "HEAD").strip()
    rustc = output("rustc", "--version").split()[1]
    compiler = output(os.environ.get("CXX", "g++"), "--version").splitlines()[0]
    peers = f"MuJoCo {version('mujoco')}, Pinocchio {version('pin')}, Drake {version('drake')}, rapier 0.32.0"
    versions = f"{peers}; rustc {rustc}, {compiler}, Python {platform.python_version()}"
    date = datetime.date.today().isoformat()
    return {"processor": processor(), "cores": os.cpu_count(), "date": date, "commit": commit, "versions": versions}


def size(x):
    return "–" if not math.isfinite(x) else "0" if x == 0 else f"{x:.1e}"


def short(x):
    """A number with two digits, without an exponent."""
    rounded = float(f"{x:.2g}")
    return f"{rounded:,.0f}" if rounded >= 10 else f"{rounded:g}"


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def fastest(rows, error):
    """The fastest run with at most this error; nothing where there is none."""
    good = [r for r in rows if r["error"] <= error]
    return min(good, key=lambda r: r["seconds"], default=None)


def at_equal_error(rows, scene):
    """For each error the simulated seconds a second of each system's fastest run of one state, and bgdyn's over them."""
    lines = []
    for error in ERRORS:
        cells = [f"{error:g}"]
        some = [r for r in rows if r["scene"] == scene and not r["shared"]]
        own = fastest([r for r in some if r["system"] == "bgdyn" and "lanes" not in r["setting"]], error)
        for system in SYSTEMS:
            one = [r for r in some if r["system"] == system and "lanes" not in r["setting"]]
            if not one:
                continue
            found = fastest(one, error)
            if found is None:
                cells.append("not reached")
                continue
            words = f"{short(1 / found['seconds'])} ({found['setting']}, {found['given']:g})"
            if system != "bgdyn" and own:
                words += f": bgdyn **{short(found['seconds'] / own['seconds'])} times**"
            cells.append(words)
        lines.append(cells)
    present = [s for s in SYSTEMS if any(r["scene"] == scene and r["system"] == s for r in rows)]
    return table(["error at most, rad", *present], lines)


def many(rows, scene):
    """The same for many states at once: bgdyn in lanes beside one state of the peers, and on all cores."""
    lines = []
    for error in ERRORS:
        some = [r for r in rows if r["scene"] == scene]
        cells = [f"{error:g}"]
        for lanes, shared in (("rk4, 8 lanes", False), ("rk4, 8 lanes, all cores", True)):
            own = fastest([r for r in some if r["setting"] == lanes], error)
            peers = [r for r in some if r["system"] != "bgdyn" and r["shared"] == shared]
            other = fastest(peers, error)
            if own is None:
                cells += ["not reached", "–"]
                continue
            cells.append(short(1 / own["seconds"]))
            if other is None:
                cells.append("not reached")
            else:
                ratio = short(other["seconds"] / own["seconds"])
                cells.append(f"{short(1 / other['seconds'])} ({other['system']}, {other['setting']}): bgdyn **{ratio} times**")
        lines.append(cells)
    heads = ["error at most, rad", "bgdyn, 8 lanes", "the fastest peer", "bgdyn, 8 lanes, all cores", "the fastest peer on all cores"]
    return table(heads, lines)


def section(rows, scene):
    some = [r for r in rows if r["scene"] == scene]
    body = []
    for system, setting in dict.fromkeys((r["system"], r["setting"]) for r in some):
        here = [r for r in some if (r["system"], r["setting"]) == (system, setting)]
        for row in here:
            seconds = row["seconds"]
            per = "–" if not math.isfinite(seconds) else short(1 / seconds)
            body.append([f"{system}, {setting}", f"{row['given']:g}", size(row["error"]), per])
    return f"""## {TITLES[scene]}
One state at a time:

{at_equal_error(rows, scene)}
Many states:

{many(rows, scene)}
All runs:

{table(["system", "steps, or tolerance", "error, rad", "simulated seconds a second"], body)}"""


def figure(rows):
    keys = list(LEGEND)

    def panel(title, some):
        series = []
        for key in dict.fromkeys((r["system"], r["setting"]) for r in some):
            points = [(1 / r["seconds"], max(r["error"], 1e-14)) for r in some if (r["system"], r["setting"]) == key]
            if MANY.get(key, key) in keys:
                series.append((keys.index(MANY.get(key, key)), points))
        return {"title": title, "x": "simulated seconds a second", "y": "error of a position, rad", "series": series}

    def of(scene, many):
        some = [r for r in rows if r["scene"] == scene and math.isfinite(r["error"])]
        return [r for r in some if ((r["system"], r["setting"]) in MANY) == many]

    panels = [panel(f"{TITLES[s]}: one state", of(s, False)) for s in TITLES]
    panels.append(panel("Viscous and dry friction: many states", of("friction", True)))
    return {"legend": list(LEGEND.values()), "panels": panels}


def text(result):
    rows = result["rows"]
    quiet = "with priority on one core (`chrt -f`, `taskset`)" if result["priority"] else "without priority"
    quick = " **A test of the scripts: few steps, one round.**" if result["quick"] else ""
    loads, checks = result["loads"], result["checks"]
    return f"""# Simulated seconds a second, compared with other systems

{result["processor"]}, {result["cores"]} cores, {result["date"]}, commit `{result["commit"]}`. {result["versions"]}. Written by `benches/peers/simulate/run.sh --docs`.{quick}

A Panda arm falls for 2 s from a bent pose, with viscous friction of 0.8 N·m·s/rad in its joints; in the second scene with dry friction, too: 0.5 N·m · tanh(v / 0.1 rad/s). All systems solve the same equations with the same numbers. The error of a run is the largest of its seven positions at the end; the reference is bgdyn's `dop853` with the tolerance 1e-13, from which 64,000 steps of RK4 in Pinocchio differ by {size(checks["viscous"])} and {size(checks["friction"])} rad. Times are the shortest of several repetitions in {result["rounds"]} round{"s" if result["rounds"] > 1 else ""} in which all systems take turns, {quiet}; the load of the machine was {min(loads):.1f} to {max(loads):.1f}. All steps are taken by loops in Rust, C and C++, without rendering and logging, and in bgdyn without account of energy.

- **bgdyn**: the scenes in [`benches/peers/simulate`](../benches/peers/simulate), compiled; `rk4` in fixed steps, `dop853` with a tolerance; `rk4` for 8 states in the lanes of a register, on one core or, one group after the other, on all.
- **MuJoCo**: joints with `damping`; the dry friction in the callback for passive forces, in C; contacts and constraints switched off. Its integrators `RK4` and `implicitfast`. *All cores*: one such run on each core.
- **Pinocchio**: `aba` in a loop of C++ compiled for this processor, from its headers; RK4, or velocities first and then positions. *All cores*: as above.
- **Drake**: `MultibodyPlant` with joint damping, continuous by its integrator of order 3 with an accuracy, or discrete. The dry friction would have to be computed in Python.
- **rapier**: multibody joints in `f64` with damping. It has no such dry friction.

![Error over simulated seconds a second](peers_simulate.svg)

Many states: hollow points are 8 lanes on one core; all others all cores.

{chr(10).join(section(rows, scene) for scene in TITLES).rstrip()}
"""
