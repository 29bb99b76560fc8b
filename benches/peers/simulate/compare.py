"""Runs both scenes in all systems, in turn, writes simulate.json, the page and the figure.

    compare.py [--quick] [--docs] [--page]

First every run once, for its error; then PEERS_ROUNDS (3) rounds of times. --quick tests the scripts: few steps, one round.
--page writes the page and the figure again from simulate.json.
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import report

sys.path.append(str(Path(__file__).resolve().parents[1]))
from machine import undisturbed  # noqa: E402

DIR = Path(os.environ["PEERS_DIR"])
ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
QUICK = "--quick" in sys.argv
ROUNDS = 1 if QUICK else int(os.environ.get("PEERS_ROUNDS", 3))
PATIENCE = 0.02 if QUICK else 0.3
CORES = os.cpu_count()
FLAT = str(DIR / "robots/panda7/panda7.flat")

STEPS = [100, 200, 400, 800, 2000, 8000, 32000]
TOLERANCES = [1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12]
ACCURACIES = [1e-2, 1e-4, 1e-6, 1e-8]


def runs(scene):
    """System, setting, numbers, command before the numbers, and whether all cores share the work."""
    own = str(DIR / "bin/simulate")
    cpp = str(DIR / "bin/simulate_runs")
    drake = [sys.executable, str(HERE / "drake_runs.py"), FLAT]
    yield "bgdyn", "rk4", STEPS, [own, scene, "rk4"], False
    yield "bgdyn", "dop853", TOLERANCES, [own, scene, "dop853"], False
    yield "bgdyn", "rk4, 8 lanes", STEPS, [own, scene, "lanes"], False
    yield "bgdyn", "rk4, 8 lanes, all cores", STEPS, [own, scene, "cores"], True
    for method in ("RK4", "implicitfast"):
        yield "MuJoCo", method, STEPS, [cpp, "mujoco", FLAT, scene, method], False
    yield "MuJoCo", "RK4, all cores", STEPS, [cpp, "mujoco", FLAT, scene, "RK4"], True
    for method in ("rk4", "semi_implicit"):
        yield "Pinocchio", method, STEPS, [cpp, "pinocchio", FLAT, scene, method], False
    yield "Pinocchio", "rk4, all cores", STEPS, [cpp, "pinocchio", FLAT, scene, "rk4"], True
    if scene == "viscous":
        yield "Drake", "runge_kutta3", ACCURACIES, [*drake, "runge_kutta3"], False
        yield "Drake", "discrete", STEPS[:-1], [*drake, "discrete"], False
        yield "rapier", "multibody", STEPS[:-1], [str(DIR / "bin/rapier"), FLAT], False
PREFIX = undisturbed()


def lines(command, numbers, shared, patience):
    """What a program prints for these numbers. Programs that do not share the cores themselves run once on each."""
    copies = CORES if shared and Path(command[0]).name != "simulate" else 1
    environment = {**os.environ, "PEERS_PATIENCE": str(patience)}
    found = []
    for number in numbers:
        words = [*([] if shared else PREFIX), *command, repr(number)]
        started = [subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) for _ in range(copies)]
        printed = [json.loads(one.communicate()[0]) for one in started]
        if any(one.returncode for one in started):
            sys.exit(f"{' '.join(words)} failed")
        seconds = sum(one["seconds"] for one in printed) / copies**2
        found.append(printed[0] | {"seconds": seconds})
    return found


def reference(scene):
    """The positions at the end: bgdyn by `dop853`, and how far Pinocchio is from it with 64,000 steps of RK4."""
    own, = lines([str(DIR / "bin/simulate"), scene, "dop853"], [1e-13], False, 0)
    other, = lines([str(DIR / "bin/simulate_runs"), "pinocchio", FLAT, scene, "rk4"], [64000], False, 0)
    return own["positions"], error(other["positions"], own["positions"])


def error(q, exact):
    """The largest error of a position, rad; infinite where one is no number."""
    if any(x is None or not math.isfinite(x) for x in q):
        return math.inf
    return max(abs(a - b) for a, b in zip(q, exact))


def measured():
    rows, checks = [], {}
    for scene in ("viscous", "friction"):
        exact, checks[scene] = reference(scene)
        for system, setting, numbers, command, shared in runs(scene):
            for number, found in zip(numbers, lines(command, numbers[: 3 if QUICK else None], shared, 0)):
                row = {"scene": scene, "system": system, "setting": setting, "given": number, "shared": shared}
                rows.append(row | {"error": error(found["positions"], exact), "seconds": math.inf, "command": command})
                print(json.dumps({k: v for k, v in rows[-1].items() if k != "command"}), flush=True)
    loads = [os.getloadavg()[0]]
    for k in range(ROUNDS):
        for row in rows:
            if math.isfinite(row["error"]):
                found, = lines(row["command"], [row["given"]], row["shared"], PATIENCE)
                row["seconds"] = min(row["seconds"], found["seconds"])
        loads.append(os.getloadavg()[0])
        print(f"round {k + 1} of {ROUNDS}", flush=True)
    for row in rows:
        del row["command"]
    result = {"rows": rows, "checks": checks, "loads": loads, "rounds": ROUNDS, "priority": bool(PREFIX), "quick": QUICK}
    return result | report.circumstances(ROOT)


def main():
    target = ROOT / "docs" if "--docs" in sys.argv else DIR
    kept = DIR / "simulate.json"
    if "--page" in sys.argv:
        result = json.loads(kept.read_text())
    else:
        result = measured()
        kept.write_text(json.dumps(result, indent=1, ensure_ascii=False))
    (target / "peers_simulate.md").write_text(report.text(result))
    numbers = json.dumps(report.figure(result["rows"]))
    subprocess.run([DIR / "bin/plots", "curves", target / "peers_simulate.svg"], input=numbers, text=True, check=True)
    print(f"wrote {target / 'peers_simulate.md'}")


if __name__ == "__main__":
    main()
