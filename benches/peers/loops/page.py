"""The page of results."""

import datetime
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))
from machine import processor  # noqa: E402

TITLES = {"parallelograms": "Two parallelograms", "five_bar": "A five-bar"}
TEXTS = {
    "parallelograms": (
        "Problem A02 of the IFToMM library of computational benchmark problems with two windows: five rods of 1 m and 1 kg "
        "([`parallelograms.yaml`](../specs/loops/parallelograms.yaml)), upright with 1 rad/s at the start, {end:g} s. Twice "
        "per turn all rods lie flat: there the rows of the loops depend on each other, and couplers and rods could turn "
        "against each other. The reference keeps the couplers parallel to the ground. *Error* is that of the end of the "
        "first rod at the end, m; *energy* the change of the energy over 24.5 J."
    ),
    "five_bar": (
        "[`five_bar.yaml`](../specs/loops/five_bar.yaml) with springs and harmonic torques at its two cranks, 3 s, far from "
        "singular positions. *Error* is the larger error of both cranks at the end, rad; *energy* the error of the energy "
        "at the end over 4.7 J."
    ),
}
TARGETS = [1e-3, 1e-6, 1e-9]


def size(x):
    if x is None:
        return "–"
    return "0" if x == 0 else f"{x:.1e}"


def time(seconds):
    if seconds is None:
        return "–"
    for unit, scale in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def line(one):
    head = [one["system"], one["setting"], f"{one['step']:g}", size(one["gap"])]
    if one.get("refused") is not None:
        return [*head, f"refused at {one['refused']:.2f} s: singular position", "", "", ""]
    if one.get("diverged") is not None:
        return [*head, f"diverged at {one['diverged']:.2f} s", "", "", ""]
    return [*head, size(one["error"]), size(one["energy"]), time(one["seconds"]), one["inside"]]


def fastest(rows, system, target):
    some = [r for r in rows if r["system"] == system and r.get("error", 1.0) <= target]
    return min(some, key=lambda r: r["seconds"], default=None)


def equal_errors(rows):
    """For each bound of the error the fastest run of each system."""
    systems = list(dict.fromkeys(r["system"] for r in rows))
    lines = []
    for target in TARGETS:
        best = {system: fastest(rows, system, target) for system in systems}
        own = best["bgdyn"]
        cells = [f"{target:g}"]
        for system in systems:
            one = best[system]
            if one is None:
                cells.append("not reached")
            elif system == "bgdyn" or own is None:
                cells.append(f"{time(one['seconds'])} (step {one['step']:g})")
            else:
                ratio = one["seconds"] / own["seconds"]
                cells.append(f"{float(f'{ratio:.2g}'):g} times ({one['inside']}, step {one['step']:g})")
        lines.append(cells)
    return table(["error at most", *systems], lines)


def text(rows, root: Path, quick, times):
    git = subprocess.run(["git", "-C", root, "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True)
    versions = f"Pinocchio {version('pin')}, MuJoCo {version('mujoco')}, Drake {version('drake')}, Python {platform.python_version()}"
    whole = [
        "# Closed loops in other systems\n",
        f"{processor()}, {datetime.date.today()}, commit `{git.stdout.strip()}`. {versions}. Written by `benches/peers/loops/run.sh --docs`."
        + (" **A test of the scripts: short runs, times of one round.**" if quick else "")
        + ("" if times else " Times were not measured (`--without-times`).") + "\n",
        f"![Error of each run over its {'time' if times else 'step'}](peers_loops.svg)\n",
        "Each run has a fixed step. *Gap* is the largest distance of two pins that should coincide, after each step, m. "
        "*Time* is that of a simulated second, the shortest of several rounds in which all runs take turns, without the "
        "measurement of gaps. The last column says what loops over the steps: where Python does or computes drives, the time is "
        "that of Python's calls too, and says little about the speed of the library.\n",
        "- bgdyn: RK4 in the independent velocities, compiled Rust. Loops are closed after each step; there are no gains.\n"
        "- Pinocchio: `constraintDynamics` with a 3-D point for each pin; μ is the proximal damping, Kp and Kd are the gains "
        "of the stabilisation. The loop over steps, and RK4, are Python's.\n"
        "- MuJoCo: equality constraints `connect`, as soft as they are by default, or as stiff as the step allows "
        "(`solref` 2 h, `solimp` 0.9999).\n"
        "- Drake: a discrete plant with the SAP solver and `AddBallConstraint`.\n",
    ]
    for name, title in TITLES.items():
        some = [r for r in rows if r["mechanism"] == name]
        whole.append(f"## {title}\n")
        whole.append(TEXTS[name].format(end=1 if quick else 10) + "\n")
        heads = ["system", "setting", "step, s", "gap, m", "error", "energy", "time", "steps by"]
        whole.append(table(heads, [line(r) for r in some]))
        if name == "parallelograms":
            whole.append(
                "*Parallel rods*: `branch: parallel`, on which couplers stay parallel to the ground "
                "([`parallel_rods.yaml`](../specs/loops/parallel_rods.yaml)), has no singular position. "
                "*Pins*: the loops as they are; bgdyn refuses the flat position.\n"
            )
        if not times:
            continue
        whole.append("Time at equal error, the fastest run of each system; times of others over that of bgdyn:\n")
        whole.append(equal_errors(some))
    return "\n".join(whole)
