"""Runs the cases in all systems, in turn, writes contact.json, the page and the figures.

    compare.py [--quick] [--docs] [--page]

First every run once, for its error; then PEERS_ROUNDS (3) rounds of times. --quick tests the scripts: long steps, one
round. --page writes the page and figures again from contact.json.
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import figures
import report
from cases import CASES, STEPS, TOLERANCES

sys.path.append(str(Path(__file__).resolve().parents[1]))
from machine import undisturbed  # noqa: E402

DIR = Path(os.environ["PEERS_DIR"])
ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
QUICK = "--quick" in sys.argv
ROUNDS = 1 if QUICK else int(os.environ.get("PEERS_ROUNDS", 3))
# Seconds for the repetitions of a run.
PATIENCE = 0.01 if QUICK else 0.1

PROGRAMS = {
    "bgdyn": [str(DIR / "bin/contact")],
    "MuJoCo": [sys.executable, str(HERE / "mujoco_cases.py")],
    "Drake": [sys.executable, str(HERE / "drake_cases.py")],
}
# Settings of the systems in a case.
SETTINGS = [("bgdyn", "moreau"), ("MuJoCo", "default"), ("MuJoCo", "stiff"), ("Drake", "lagged"), ("Drake", "sap")]
SPECIAL = {
    "bounces": [("bgdyn", "moreau"), ("MuJoCo", "spring")],
    "stands": [("bgdyn", "moreau"), ("MuJoCo", "default"), ("MuJoCo", "stiff")],
    "compliant": [("bgdyn", "dopri5"), ("Drake", "continuous"), ("Drake", "spring")],
}
CONTROLLED = ["dopri5", "continuous"]
PREFIX = undisturbed()


def lines(system, setting, case, more, numbers, patience, repeats, prefix):
    """What a program prints for these numbers of steps, or tolerances."""
    settings = [] if system == "bgdyn" else [setting]
    command = [*prefix, *PROGRAMS[system], case, *settings]
    if system == "bgdyn":
        command.append(repr(CASES[case].end))
    environment = {**os.environ, "PEERS_PATIENCE": str(patience), "PEERS_REPEATS": str(repeats)}
    command += [repr(more), *map(repr, numbers)]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr}")
    found = [json.loads(line) for line in done.stdout.splitlines()]
    if len(found) != len(numbers):
        sys.exit(f"{' '.join(command)} printed {len(found)} runs, not {len(numbers)}")
    return found


def errors(case, found):
    """The largest error of runs; infinite where one is no number."""
    worst = [CASES[case].error(run["values"]) for run in found]
    return max(x if math.isfinite(x) else math.inf for x in worst)


def measured(case, system, setting):
    """The rows of a system: steps or tolerances, and errors."""
    one = CASES[case]
    controlled = setting in CONTROLLED
    rows = []
    possible = TOLERANCES if controlled else [step for step in STEPS if step <= one.longest]
    for given in possible[: 2 if QUICK else None]:
        numbers = [given] if controlled else one.steps(given)
        first = lines(system, setting, case, one.more, numbers[:1], 0, 1, [])
        rest = lines(system, setting, case, 0.0, numbers[1:], 0, 1, []) if numbers[1:] else []
        row = {"case": case, "system": system, "setting": setting, "controlled": controlled, "given": given}
        row |= {"number": numbers[0], "error": errors(case, first + rest), "seconds": math.inf}
        if one.creep:
            row["creep"] = one.creep(first[0]["values"])
        rows.append(row)
        print(json.dumps(row, ensure_ascii=False), flush=True)
    return rows


def lifts():
    """How the slipping disc leaves the slope in steps of 1 ms, by system and setting."""
    for system, setting in SETTINGS[1:]:
        command = [*PROGRAMS[system], "lift", setting, str(CASES["slips"].steps(1e-3)[0])]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        yield {"system": system, "setting": setting, **json.loads(done.stdout)}


def main():
    target = ROOT / "docs" if "--docs" in sys.argv else DIR
    kept = DIR / "contact.json"
    if "--page" in sys.argv:
        result = json.loads(kept.read_text())
    else:
        order = [(case, *who) for case in CASES for who in SPECIAL.get(case, SETTINGS)]
        rows = {key: measured(*key) for key in order}
        loads = [os.getloadavg()[0]]
        for k in range(ROUNDS):
            for (case, system, setting), some in rows.items():
                found = lines(system, setting, case, 0.0, [r["number"] for r in some], PATIENCE, 3, PREFIX)
                for row, timed in zip(some, found):
                    row["seconds"] = min(row["seconds"], timed["seconds"] / CASES[case].end)
            loads.append(os.getloadavg()[0])
            print(f"round {k + 1} of {ROUNDS}", flush=True)
        result = {"rows": sum(rows.values(), []), "loads": loads, "rounds": ROUNDS, "priority": bool(PREFIX), "quick": QUICK}
        result |= {"lifts": list(lifts()), **report.circumstances(ROOT)}
        kept.write_text(json.dumps(result, indent=1, ensure_ascii=False))
    (target / "peers_contact.md").write_text(report.text(result))
    figures.write(result["rows"], DIR / "bin/plots", target)
    print(f"wrote {target / 'peers_contact.md'}")


if __name__ == "__main__":
    main()
