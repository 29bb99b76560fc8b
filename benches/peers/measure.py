"""Times the peers in turn with ours, compares the results, writes results.json, the page and the plot.

    measure.py [--free] [--docs] SPEC ...

Machines with a floating joint are measured beside generated C and Pinocchio, and have a part of the page of their own;
with --free it is the only part that is written. Fails where results differ, or where nothing was compared.
"""

import json
import math
import os
import statistics
import subprocess
import sys
from pathlib import Path

import free
import page
import plot
from machine import undisturbed

DIR = Path(os.environ["PEERS_DIR"])
ROOT = Path(__file__).resolve().parents[2]
ROUNDS = int(os.environ.get("PEERS_ROUNDS", 5))
# Checksums of two programs may differ by this much of their size.
AGREE = 1e-7

OPERATIONS = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
]
COMPILERS = ["clang-19", "gcc"]
# The peers whose outputs are compared one by one, for machines with a floating joint.
COMPARED = ["casadi", "cppad", "pinocchio"]
# The states in which they are.
VALUES = 16
PREFIX = undisturbed()


def run(command):
    """Time of a call, ns, and checksum; nothing where the program cannot."""
    environment = {"PEERS_SECONDS": "0.05", **os.environ}
    done = subprocess.run([*PREFIX, *command], capture_output=True, text=True, env=environment)
    if done.returncode:
        return None
    time, checksum = done.stdout.split()[-2:]
    return float(time), float(checksum)


def floats(robot):
    """Whether it has a floating joint."""
    return " floating " in (DIR / "robots" / robot / f"{robot}.flat").read_text()


def outputs(command):
    """All outputs in some states, a list for each."""
    environment = {**os.environ, "PEERS_VALUES": str(VALUES)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    states = [[float(word) for word in line.split()] for line in done.stdout.splitlines()]
    if len(states) != VALUES:
        sys.exit(f"{' '.join(command)} printed {len(states)} states, not {VALUES}")
    return states


def difference(mine, other):
    """The largest difference of an output, relative to the largest of its state; infinite for other numbers of outputs."""
    worst = 0.0
    for a, b in zip(mine, other, strict=True):
        gaps = [abs(x - y) for x, y in zip(a, b)]
        # Written so that a NaN is a difference as well.
        fine = len(a) == len(b) and all(gap < math.inf for gap in gaps)
        worst = max(worst, max(gaps) / max(map(abs, a)) if fine else math.inf)
    return worst


def contenders(robot, operation):
    """Programs by column; a column's best counts."""
    folder = DIR / "robots" / robot
    flat = str(folder / f"{robot}.flat")
    program = lambda name: [str(DIR / "bin" / name), flat, operation]
    ours = lambda name, *lanes: [str(DIR / "bin" / name), robot, operation, *lanes]
    others = ["pinocchio"] if floats(robot) else ["pinocchio", "mujoco", "kdl", "dynibo"]
    columns = {name: [program(name)] for name in others}
    for generator in ["casadi", "cppad"]:
        libraries = [folder / f"{generator}_{operation}.{compiler}.so" for compiler in COMPILERS]
        columns[generator] = [[*program("generated"), str(x)] for x in libraries if x.exists()]
    if floats(robot):
        return ours("ours"), columns
    lanes = folder / f"casadi_{operation}.lanes.so"
    columns["casadi lanes"] = [[*program("generated_lanes"), str(lanes)]] if lanes.exists() else []
    columns["ours portable"] = [ours("ours_portable")]
    columns["ours 4 lanes"] = [ours("ours", "4")]
    columns["ours 8 lanes"] = [ours("ours", "8")]
    return ours("ours"), columns


def measure(robot, operation):
    """Our time, and for each column its time and the median of ours over it, round by round."""
    ours, columns = contenders(robot, operation)
    first = run(ours)
    if first is None:
        return None
    runs, wrong, worst = [], [], 0.0
    mine = outputs(ours) if floats(robot) else None
    for column, commands in columns.items():
        found = [(command, run(command)) for command in commands]
        found = [(command, result) for command, result in found if result]
        equal = lambda result: abs(result[1] - first[1]) <= AGREE * max(1.0, abs(first[1]))
        some = any(equal(result) for _, result in found)
        for command, result in found:
            gap = difference(mine, outputs(command)) if mine and column in COMPARED else 0.0
            worst = max(worst, gap)
            if gap > free.AGREE:
                sys.exit(f"{robot}, {operation}: {' '.join(command)} differs by {gap:.1e}, allowed are {free.AGREE:.0e}")
            if equal(result):
                runs.append((column, command, [], []))
            elif some and command[-1].endswith(".so"):
                # Of the same C another compiler makes a program that agrees.
                name = Path(command[-1]).name
                print(f"{robot}, {operation}: {name} gives {result[1]}, not {first[1]}: left out", flush=True)
                wrong.append(name.split(".")[-2])
            else:
                sys.exit(f"{robot}, {operation}: {' '.join(command)} gives {result[1]}, not {first[1]}")
    own_times = []
    for _ in range(ROUNDS):
        for _, command, times, ratios in runs:
            own, other = run(ours)[0], run(command)[0]
            own_times.append(own)
            times.append(other)
            ratios.append(own / other)
    result = {"robot": robot, "operation": operation, "ours": statistics.median(own_times), "wrong": wrong, "columns": {}}
    result["difference"] = worst
    for column, command, times, ratios in runs:
        entry = {"command": command, "time": statistics.median(times), "ratio": statistics.median(ratios)}
        entry["spread"] = [min(ratios), max(ratios)]
        best = result["columns"].get(column)
        if best is None or entry["ratio"] > best["ratio"]:
            result["columns"][column] = entry
    return result


def all_results(specs, operations):
    results = []
    for spec in specs:
        for operation in operations:
            result = measure(spec.stem, operation)
            if result is None:
                continue
            result["spec"] = os.path.relpath(spec, ROOT)
            results.append(result)
            shares = [f"{name} {c['ratio']:.2f}" for name, c in result["columns"].items()]
            print(f"{spec.stem} {operation}: {result['ours']:.1f} ns; over {', '.join(shares)}", flush=True)
    return results


def main():
    options = {a for a in sys.argv[1:] if a.startswith("--")}
    specs = [Path(a) for a in sys.argv[1:] if a not in options]
    target = ROOT / "docs" if "--docs" in options else DIR
    free_specs = [spec for spec in specs if floats(spec.stem)]
    free_results = all_results(free_specs, free.OPERATIONS)
    if len(free_results) < len(free_specs) * len(free.OPERATIONS) or not all(r["columns"] for r in free_results):
        sys.exit("nothing was compared for some function of a machine with a floating joint")
    place = target / "peers.md"
    if "--free" in options:
        if not free_results:
            sys.exit("no machine with a floating joint: nothing was compared")
        results = []
        text = place.read_text() if place.exists() else ""
    else:
        results = all_results([spec for spec in specs if spec not in free_specs], OPERATIONS)
        if not any(r["columns"] for r in results):
            sys.exit("nothing was compared")
        text = page.text(results, ROUNDS, bool(PREFIX), DIR)
        plot.write(results, DIR / "bin/plots", target / "peers.svg")
    if free_results:
        text = free.put(text, free.section(free_results, ROUNDS, bool(PREFIX), DIR))
    (DIR / "results.json").write_text(json.dumps(results + free_results, indent=1))
    place.write_text(text)
    print(f"wrote {place}")


if __name__ == "__main__":
    main()
