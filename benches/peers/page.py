"""The page of results."""

import datetime
import re
from pathlib import Path

from machine import output, processor

TITLES = {
    "inverse_dynamics": "Inverse dynamics",
    "mass_matrix": "Mass matrix",
    "forward_dynamics": "Forward dynamics",
    "inverse_dynamics_derivatives": "∂τ/∂q, ∂τ/∂v",
    "forward_dynamics_derivatives": "∂q̈/∂q, ∂q̈/∂v, M⁻¹",
}
PEERS = {
    "generated C": ["casadi", "cppad"],
    "Pinocchio": ["pinocchio"],
    "MuJoCo": ["mujoco"],
    "KDL": ["kdl"],
    "dynibo": ["dynibo"],
}


def entry(result, columns):
    """The best of a result's columns: the one that ours takes the largest share of."""
    found = [result["columns"][c] for c in columns if c in result["columns"]]
    return max(found, key=lambda e: e["ratio"], default=None)


def ratio(entry):
    return f"{entry['ratio']:.2f}" if entry else "–"


def time(ns):
    return f"{ns:.1f}" if ns < 100 else f"{ns:.0f}"


def function(result):
    title = TITLES[result["operation"]]
    return title[0].lower() + title[1:]


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def section(title, text, heads, rows):
    return f"## {title}\n\n{text}\n\n{table(heads, rows)}\n" if rows else ""


def alone(results):
    """A table for each operation, one state a call."""
    text = ""
    for operation, title in TITLES.items():
        some = [r for r in results if r["operation"] == operation]
        peers = {p: c for p, c in PEERS.items() if any(entry(r, c) for r in some)}
        if not some:
            continue
        rows = [[r["robot"], time(r["ours"]), *[ratio(entry(r, c)) for c in peers.values()]] for r in some]
        text += f"### {title}\n\n{table(['robot', 'bgdyn, ns', *peers], rows)}\n"
    return text


def lanes(results):
    rows = []
    for r in results:
        eight, four, casadi = [r["columns"].get(c) for c in ["ours 8 lanes", "ours 4 lanes", "casadi lanes"]]
        if not eight:
            continue
        compared = f"{eight['time'] / casadi['time']:.2f}" if casadi else "–"
        peer = time(casadi["time"]) if casadi else "–"
        cells = [time(four["time"]), time(eight["time"]), peer, compared]
        rows.append([r["robot"], function(r), time(r["ours"]), *cells])
    heads = ["robot", "function", "one state, ns", "4 lanes", "8 lanes", "CasADi, 8 lanes", "8 lanes over CasADi's"]
    text = (
        "Times per state, ns: `f64x4` and `f64x8` of the crate `wide` as scalars of the same generated code; CasADi's C "
        "compiled for vectors of eight doubles, with the sines of glibc's vector library."
    )
    return section("States in lanes", text, heads, rows)


def portable(results):
    rows = []
    for r in results:
        other = r["columns"].get("ours portable")
        if other:
            rows.append([r["robot"], function(r), time(r["ours"]), time(other["time"])])
    heads = ["robot", "function", "this machine's instructions, ns", "cargo's default, ns"]
    text = "Compiled with `-C target-cpu=native`, and as cargo does by default."
    return section("Without the machine's own instructions", text, heads, rows)


def origin(results):
    """Where the specs are."""
    folders = {}
    for spec in dict.fromkeys(r["spec"] for r in results):
        folders.setdefault(str(Path(spec).parent), []).append(f"`{Path(spec).stem}`")
    places = [f"{', '.join(names)} from [`{f}`](../{f})" for f, names in folders.items()]
    return f"Robots: {'; '.join(places)}. Chains have revolute joints about skew axes, as many as their names say.\n"


def left_out(results):
    """Programs that computed something else; another compiler's of the same C agrees."""
    found = [f"{r['robot']}'s {function(r)} by {compiler}" for r in results for compiler in r["wrong"]]
    if not found:
        return ""
    return f"- Left out, because the sums disagree (the other compiler's program of the same C agrees): {'; '.join(found)}.\n"


def versions(folder):
    pip = output(str(folder / "venv/bin/pip"), "list", "--format=freeze")
    pip = dict(line.split("==") for line in pip.split() if "==" in line)
    kdl = re.search(r"Version: ([0-9.]+)", output("dpkg", "-s", "liborocos-kdl-dev"))
    clang = re.search(r"version ([0-9.]+)", output("clang-19", "--version"))
    gcc = output("gcc", "-dumpfullversion").strip()
    rustc = output("rustc", "--version").split()[1]
    return (
        f"Pinocchio {pip['pin']}, CasADi {pip['casadi']}, CppADCodeGen 2.4.3, MuJoCo {pip['mujoco']}, "
        f"KDL {kdl.group(1) if kdl else '?'}, dynibo 0.5.3; rustc {rustc}, clang {clang.group(1)}, gcc {gcc}"
    )


def text(results, rounds, undisturbed, folder):
    date = datetime.date.today().isoformat()
    commit = output("git", "rev-parse", "--short", "HEAD").strip()
    quiet = "on a core of their own (`chrt -f`, `taskset`)" if undisturbed else "on a machine that did other work too"
    return f"""# Times compared with other systems

{processor()}, {date}, commit `{commit}`. {versions(folder)}. Written by `benches/peers/run.sh --docs`.

![How many times as long as bgdyn](peers.svg)

Every program runs over the same 1024 random states (any angle, ±0.3 m, velocities and accelerations within ±2, efforts within ±10) and prints the median time of a call and the sum of all its outputs; the sums agree to 1e-7. Each peer ran in turn with bgdyn, {rounds} rounds, {quiet}; columns are medians of **bgdyn's time over the peer's**: 0.25 means four times as fast. Only ratios carry over to other machines.

- Generated C is Pinocchio's algorithms over CasADi's expressions (common subexpressions shared) or over CppADCodeGen's tape, compiled by clang and by gcc with `-O3 -march=native`: of the four, the fastest for each function. Beyond 12 joints clang alone, in a minute at most for each.
- Pinocchio is compiled from its headers, `-O3 -march=native`. MuJoCo and KDL are their packages' libraries, MuJoCo with only the parts that the function needs. dynibo is compiled like bgdyn, for this machine.
- A dash: the peer has no such function, or cannot take the mechanism, or its C was not compiled in the time given to it.
{left_out(results)}
{origin(results)}
## One state a call, f64

{alone(results)}{lanes(results)}{portable(results)}""".rstrip() + "\n"
