"""Times the peers in turn with ours, compares the results, writes results.json, the page and the plot.

    measure.py [--docs] SPEC ...
"""

import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

import page
import plot

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


def undisturbed():
    """What to put in front of a program: one core, ahead of everything else, where that is allowed."""
    prefix = ["chrt", "-f", "10", "taskset", "-c", str(max(os.sched_getaffinity(0)))]
    try:
        allowed = subprocess.run([*prefix, "true"], capture_output=True).returncode == 0
    except FileNotFoundError:
        allowed = False
    return prefix if allowed else []


PREFIX = undisturbed()


def run(command):
    """Time of a call, ns, and checksum; nothing where the program cannot."""
    environment = {"PEERS_SECONDS": "0.05", **os.environ}
    done = subprocess.run([*PREFIX, *command], capture_output=True, text=True, env=environment)
    if done.returncode:
        return None
    time, checksum = done.stdout.split()[-2:]
    return float(time), float(checksum)


def contenders(robot, operation):
    """Programs by column; a column's best counts."""
    folder = DIR / "robots" / robot
    flat = str(folder / f"{robot}.flat")
    program = lambda name: [str(DIR / "bin" / name), flat, operation]
    ours = lambda name, *lanes: [str(DIR / "bin" / name), robot, operation, *lanes]
    columns = {name: [program(name)] for name in ["pinocchio", "mujoco", "kdl", "dynibo"]}
    for generator in ["casadi", "cppad"]:
        libraries = [folder / f"{generator}_{operation}.{compiler}.so" for compiler in COMPILERS]
        columns[generator] = [[*program("generated"), str(x)] for x in libraries if x.exists()]
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
    runs, wrong = [], []
    for column, commands in columns.items():
        found = [(command, run(command)) for command in commands]
        found = [(command, result) for command, result in found if result]
        equal = lambda result: abs(result[1] - first[1]) <= AGREE * max(1.0, abs(first[1]))
        some = any(equal(result) for _, result in found)
        for command, result in found:
            if equal(result):
                runs.append((column, command, [], []))
            elif some and command[-1].endswith(".so"):
                # Of the same C another compiler makes a program that agrees.
                name = Path(command[-1]).name
                print(f"{robot}, {operation}: {name} gives {result[1]}, not {first[1]}: left out", flush=True)
                wrong.append(name.split(".")[-2])
            else:
                sys.exit(f"{robot}, {operation}: {' '.join(command)} gives {result[1]}, not {first[1]}")
    mine = []
    for _ in range(ROUNDS):
        for _, command, times, ratios in runs:
            own, other = run(ours)[0], run(command)[0]
            mine.append(own)
            times.append(other)
            ratios.append(own / other)
    result = {"robot": robot, "operation": operation, "ours": statistics.median(mine), "wrong": wrong, "columns": {}}
    for column, command, times, ratios in runs:
        entry = {"time": statistics.median(times), "ratio": statistics.median(ratios)}
        entry["spread"] = [min(ratios), max(ratios)]
        best = result["columns"].get(column)
        if best is None or entry["ratio"] > best["ratio"]:
            result["columns"][column] = entry
    return result


def main():
    arguments = sys.argv[1:]
    target = ROOT / "docs" if "--docs" in arguments else DIR
    results = []
    for spec in [Path(a) for a in arguments if a != "--docs"]:
        robot = spec.stem
        for operation in OPERATIONS:
            result = measure(robot, operation)
            if result is None:
                continue
            result["spec"] = os.path.relpath(spec, ROOT)
            results.append(result)
            shares = [f"{name} {c['ratio']:.2f}" for name, c in result["columns"].items()]
            print(f"{robot} {operation}: {result['ours']:.1f} ns; over {', '.join(shares)}", flush=True)
    (DIR / "results.json").write_text(json.dumps(results, indent=1))
    (target / "peers.md").write_text(page.text(results, ROUNDS, bool(PREFIX), DIR))
    (target / "peers.svg").write_text(plot.svg(results))
    print(f"wrote {target / 'peers.md'} and {target / 'peers.svg'}")


if __name__ == "__main__":
    main()
