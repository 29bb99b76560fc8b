"""The page of results."""

import datetime
import math
import os
import platform
import statistics
import sys
from importlib.metadata import version
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))
from cases import CASES, RUNS, STEPS  # noqa: E402
from machine import output, processor  # noqa: E402

NAMES = {
    ("bgdyn", "moreau"): "bgdyn",
    ("bgdyn", "dopri5"): "bgdyn, `dopri5`",
    ("MuJoCo", "default"): "MuJoCo, default",
    ("MuJoCo", "stiff"): "MuJoCo, stiff",
    ("MuJoCo", "spring"): "MuJoCo, spring",
    ("Drake", "lagged"): "Drake, lagged",
    ("Drake", "sap"): "Drake, near rigid",
    ("Drake", "continuous"): "Drake, continuous",
    ("Drake", "spring"): "Drake, lagged",
}
# What bgdyn's error is at the least: smaller ones are rounding.
ROUNDING = 1e-13


def circumstances(root):
    """What is known while measuring: machine, versions, commit."""
    commit = output("git", "-C", str(root), "rev-parse", "--short=8", "HEAD").strip()
    rustc = output("rustc", "--version").split()[1]
    versions = f"MuJoCo {version('mujoco')}, Drake {version('drake')}; rustc {rustc}, Python {platform.python_version()}"
    date = datetime.date.today().isoformat()
    return {"processor": processor(), "cores": os.cpu_count(), "date": date, "commit": commit, "versions": versions}


def size(x):
    if x is None or not math.isfinite(x):
        return "–"
    return "0" if x == 0 else f"{x:.1e}"


def short(x):
    """A number with two digits, without an exponent."""
    if not math.isfinite(x):
        return "–"
    rounded = float(f"{x:.2g}")
    return f"{rounded:,.0f}" if rounded >= 10 else f"{rounded:g}"


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def best(rows):
    """Errors and times of the runs that no other run beats in both, from the fastest to the most accurate."""
    front = []
    for row in sorted(rows, key=lambda r: r["seconds"]):
        if not front or row["error"] < front[-1]["error"]:
            front.append(row)
    return front


def time_at(front, error):
    """Time for this error between two runs, by powers; and whether even the fastest run is better. Nothing where no run is
    as good."""
    if front[0]["error"] <= error:
        return front[0]["seconds"], front[0]["error"] < 0.99 * error
    for a, b in zip(front, front[1:]):
        if b["error"] <= error:
            floor = lambda x: math.log(max(x, ROUNDING))
            part = (floor(a["error"]) - math.log(error)) / (floor(a["error"]) - floor(b["error"]))
            return a["seconds"] * (b["seconds"] / a["seconds"]) ** min(max(part, 0.0), 1.0), False
    return None


def ratio(row, front):
    """The time of a run over that of bgdyn at the same error."""
    if not math.isfinite(row["error"]):
        return "–"
    found = time_at(front, row["error"])
    if found is None:
        return "not reached"
    seconds, better = found
    return ("≥ " if better else "") + short(row["seconds"] / seconds)


def block(some, own):
    """Rows of a table for the runs of one system: errors, creep, times, times over those of bgdyn."""
    name = NAMES[some[0]["system"], some[0]["setting"]]
    rows = [[name, "error", *[size(r["error"]) for r in some]]]
    if "creep" in some[0]:
        rows.append(["", "creep, m", *[size(r["creep"]) for r in some]])
    rows.append(["", "µs", *[short(1e6 * r["seconds"]) for r in some]])
    if own and some[0]["system"] != "bgdyn":
        rows.append(["", "times bgdyn's", *[ratio(r, own) for r in some]])
    return rows


def section(name, rows):
    case = CASES[name]
    some = [r for r in rows if r["case"] == name]
    own = best([r for r in some if r["system"] == "bgdyn"])
    unit = f" in {case.unit}" if case.unit != "1" else ""
    text = f"## {case.title}\n{case.text} Errors of the {case.of}{unit}.\n\n"
    for controlled in (True, False):
        here = [r for r in some if r["controlled"] == controlled]
        if not here:
            continue
        given = list(dict.fromkeys(r["given"] for r in here))
        heads = [f"{x:g}" if controlled else f"{1e3 * x:g} ms" for x in given]
        what = "tolerance or accuracy" if controlled else "step"
        body = []
        for key in dict.fromkeys((r["system"], r["setting"]) for r in here):
            body += block([r for r in here if (r["system"], r["setting"]) == key], own)
        text += table(["", what, *heads], body) + "\n"
    return text


def equal(own, other):
    """The time of another system over that of bgdyn at the smallest error that both reach, and this error."""
    error = max(own[-1]["error"], other[-1]["error"])
    (mine, mine_better), (theirs, theirs_better) = time_at(own, error), time_at(other, error)
    bound = {(True, False): "≥ ", (False, True): "≤ "}.get((mine_better, theirs_better), "")
    return f"{bound}{short(theirs / mine)} (at {size(error)})"


def summary(rows):
    """For each case the errors at 1 ms, and the times of the peers over that of bgdyn at the same error."""
    lines = []
    for name, case in CASES.items():
        some = [r for r in rows if r["case"] == name and math.isfinite(r["error"])]
        systems = {system: [r for r in some if r["system"] == system] for system in ("bgdyn", "MuJoCo", "Drake")}
        controlled = any(r["controlled"] for r in some)
        cells = [case.title]
        for mine in systems.values():
            at = [r["error"] for r in mine if r["given"] == (1e-6 if controlled else 1e-3)]
            cells.append(size(min(at, default=None)))
        for system in ("MuJoCo", "Drake"):
            there = systems[system]
            cells.append(equal(best(systems["bgdyn"]), best(there)) if there else "–")
        lines.append(cells)
    heads = ["case", "error: bgdyn", "MuJoCo", "Drake", "time over bgdyn's: MuJoCo", "Drake"]
    return table(heads, lines)


def lifts(found):
    """How the slipping disc leaves the slope, in words."""
    where = lambda r: NAMES[r["system"], r["setting"]]
    of = lambda r: f"{where(r)}: it touches in {100 * r['touches']:.0f} % of the steps, and rises by {1e3 * max(r['highest'], 0):.1f} mm"
    return "; ".join(map(of, found))


def per_step(rows):
    """Times of steps over those of bgdyn of the same length, in words: from the least to the largest of all cases."""
    own = {(r["case"], r["given"]): r["seconds"] for r in rows if r["system"] == "bgdyn"}
    found = {}
    for r in rows:
        if r["system"] != "bgdyn" and (r["case"], r["given"]) in own and not r["controlled"]:
            over = r["seconds"] / own[r["case"], r["given"]]
            found.setdefault(r["system"], {}).setdefault((r["case"], r["setting"]), []).append(over)
    middle = {system: [statistics.median(x) for x in cases.values()] for system, cases in found.items()}
    return "; ".join(f"{system} {short(min(x))} to {short(max(x))}" for system, x in middle.items())


def text(result):
    rows = result["rows"]
    quiet = "with priority on one core (`chrt -f`, `taskset`)" if result["priority"] else "without priority"
    loads = result["loads"]
    notes = Path(__file__).with_name("notes.md").read_text()
    quick = " **A test of the scripts: long steps, one round.**" if result["quick"] else ""
    return f"""# Contact compared with other systems

{result["processor"]}, {result["cores"]} cores, {result["date"]}, commit `{result["commit"]}`. {result["versions"]}. Written by `benches/peers/contact/run.sh --docs`.{quick}

Motions with rigid contact that have a closed form, and a quadruped, in bgdyn (`moreau`), MuJoCo and Drake, in steps from {1e3 * STEPS[0]:g} to {1e3 * STEPS[-1]:g} ms. An error is the largest of {RUNS} runs, with n, n + 1, … steps, because an impact may fall anywhere in a step. A time is that of a simulated second in µs, of the run with n steps: the shortest of several repetitions in {result["rounds"]} round{"s" if result["rounds"] > 1 else ""} in which all systems take turns, {quiet}; the load of the machine was {min(loads):.1f} to {max(loads):.1f}. All steps are taken by the libraries' own loops, in C, C++ and Rust, without rendering, logging and, in bgdyn, without account of energy.

{notes.split("<!-- tables -->")[0].strip()}

![Error over the step](peers_contact_steps.svg)

![Error over the time for a simulated second](peers_contact_times.svg)

The errors at 1 ms (the ball on a spring: at a tolerance of 1e-6), of a system's better setting; and its time over that of bgdyn **at the smallest error that both reach**, between runs by powers of the error. ≥: bgdyn's fastest run is more accurate than that; ≤: the other system's is.

{summary(rows)}
{"".join(section(name, rows) for name in CASES).rstrip()}

## What stands out
{notes.split("<!-- tables -->")[1].strip().replace("LIFTS", lifts(result["lifts"])).replace("PER_STEP", per_step(rows))}
"""
