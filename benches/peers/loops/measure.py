"""Runs both mechanisms in all systems, writes results.json, the page and the plot.

    measure.py [--quick | --without-times] [--docs]

With --quick the shortest runs only, and one round: a test of the scripts. With --without-times the page has none: for
errors alone, on a machine that others use. Times are the shortest of all rounds, in which the runs take turns.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import mechanisms
import page
import plot

DIR = Path(os.environ["PEERS_DIR"])
ROOT = Path(__file__).resolve().parents[3]
QUICK = "--quick" in sys.argv
TIMES = "--without-times" not in sys.argv
ROUNDS = 0 if not TIMES else 1 if QUICK else int(os.environ.get("PEERS_ROUNDS", 3))

MU = "μ 1e-8"


def pinocchio(words, method, steps, kp, kd, mu=1e-8):
    setting = {"method": method, "mu": mu, "kp": kp, "kd": kd}
    return ("Pinocchio", f"{words}, {method}", steps, setting)


def mujoco(words, method, steps, softness=lambda h: ""):
    return ("MuJoCo", f"`connect`, {words}, {method}", steps, {"method": method, "softness": softness})


def constant(x):
    return lambda h: x


STIFFEST = lambda h: f'solref="{2 * h!r} 1" solimp="0.9999 0.9999 0.001"'
BGDYN = {
    "parallelograms": [("bgdyn", "parallel rods, RK4", [1e-2, 1e-3, 1e-4], "parallel_rods"),
                       ("bgdyn", "pins, RK4", [1e-3], "parallelograms")],
    "five_bar": [("bgdyn", "pin, RK4", [1e-2, 1e-3, 1e-4], "five_bar")],
}
PEERS = {
    "parallelograms": [
        pinocchio("μ 0, no stabilisation", "RK4", [1e-3], constant(0), constant(0), 0.0),
        pinocchio(f"{MU}, no stabilisation", "RK4", [1e-3, 1e-4], constant(0), constant(0)),
        pinocchio(f"{MU}, Kp 100, Kd 20", "RK4", [1e-3, 1e-4], constant(100), constant(20)),
        pinocchio(f"{MU}, Kp 0.01/h², Kd 0.2/h", "RK4", [1e-3, 1e-4], lambda h: 0.01 / h**2, lambda h: 0.2 / h),
        pinocchio(f"{MU}, Kp 100, Kd 20", "semi-implicit", [1e-3, 1e-4], constant(100), constant(20)),
        pinocchio("μ 1e-5, Kp 100, Kd 20", "RK4", [1e-3, 1e-4], constant(100), constant(20), 1e-5),
        mujoco("default softness", "Euler", [1e-3, 1e-4]),
        mujoco("default softness", "RK4", [1e-3, 1e-4]),
        mujoco("stiffest", "Euler", [1e-3, 1e-4], STIFFEST),
        mujoco("stiffest", "RK4", [1e-3, 1e-4], STIFFEST),
        ("Drake", "SAP, ball constraints", [1e-2, 1e-3, 1e-4], {}),
    ],
    "five_bar": [
        pinocchio(f"{MU}, no stabilisation", "RK4", [1e-2, 1e-3], constant(0), constant(0)),
        pinocchio(f"{MU}, Kp 100, Kd 20", "RK4", [1e-2, 1e-3], constant(100), constant(20)),
        pinocchio(f"{MU}, Kp 100, Kd 20", "semi-implicit", [1e-2, 1e-3], constant(100), constant(20)),
        mujoco("default softness", "Euler", [1e-2, 1e-3]),
        mujoco("default softness", "RK4", [1e-2, 1e-3]),
        mujoco("stiffest", "Euler", [1e-2, 1e-3], STIFFEST),
        mujoco("stiffest", "RK4", [1e-2, 1e-3], STIFFEST),
        ("Drake", "SAP, ball constraint", [1e-2, 1e-3, 1e-4], {}),
    ],
}


def ours(name, step, end):
    done = subprocess.run([DIR / "bin/loops", name, repr(step), repr(end)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout) | {"inside": "Rust"}


def peer(system, mechanism, setting, step, measured):
    import drake_runs
    import mujoco_runs
    import pinocchio_runs

    of = {"Pinocchio": pinocchio_runs, "MuJoCo": mujoco_runs, "Drake": drake_runs}
    return of[system].run(mechanism, setting, step, measured)


def row(mechanism, system, words, step, found):
    """A row of the results: errors against the reference at the end."""
    one = {"mechanism": mechanism["name"], "system": system, "setting": words, "step": step, "gap": found["gap"]}
    if found.get("refused") is not None or "diverged" in found:
        return one | {"refused": found.get("refused"), "diverged": found.get("diverged")}
    q = [0.0] * len(mechanism["q"])
    if len(found["positions"]) == len(q):
        q = found["positions"]
    else:
        for k, x in zip(mechanism["compared"], found["positions"]):
            q[k] = x
    energy = abs(found["energy"] - mechanism["energy_at_end"]) / mechanism["energy_unit"]
    return one | {"error": mechanism["error"](q), "energy": energy, "seconds": found["seconds"], "inside": found["inside"]}


def runs(name, mechanism):
    """What to run: system, words, step, and a function that runs it."""
    for system, words, steps, key in BGDYN[name]:
        for step in steps[:1] if QUICK else steps:
            yield system, words, step, lambda _, key=key, step=step: ours(key, step, mechanism["end"])
    for system, words, steps, setting in PEERS[name]:
        for step in steps[:1] if QUICK else steps:
            yield system, words, step, lambda measured, a=(system, mechanism, setting, step): peer(*a, measured)


def main():
    rows = []
    for name, end in (("parallelograms", 1.0 if QUICK else 10.0), ("five_bar", 3.0)):
        mechanism = getattr(mechanisms, name)(end)
        all_runs = list(runs(name, mechanism))
        found = []
        for system, words, step, run in all_runs:
            found.append(row(mechanism, system, words, step, run(True)))
            found[-1]["seconds"] = float("inf") if TIMES and "error" in found[-1] else None
            print(json.dumps(found[-1], ensure_ascii=False), file=sys.stderr)
        for _ in range(ROUNDS):
            for one, (*_, run) in zip(found, all_runs):
                if one["seconds"] is not None:
                    timed = run(False)
                    one["seconds"] = min(one["seconds"], timed["seconds"])
                    one["inside"] = timed["inside"]
        rows += found
    (DIR / "loops.json").write_text(json.dumps(rows, indent=1, ensure_ascii=False))
    docs = ROOT / "docs" if "--docs" in sys.argv else DIR
    (docs / "peers_loops.md").write_text(page.text(rows, ROOT, QUICK, TIMES))
    plot.write(rows, DIR / "bin/plots", docs / "peers_loops.svg")
    print(f"{docs / 'peers_loops.md'}, {docs / 'peers_loops.svg'}", file=sys.stderr)


if __name__ == "__main__":
    main()
