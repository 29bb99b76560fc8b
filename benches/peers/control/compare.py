"""Times methods of controllers in turn with the peers', compares the results, writes the page.

    compare.py [--docs] SPEC ...

Fails where results differ, or where nothing was compared.
"""

import datetime
import os
import re
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import page
from measure import COMPILERS, DIR, PREFIX, ROOT, ROUNDS, outputs, run

# Times of bgdyn over those of the better C, at most.
ASKED = 0.35
# Largest difference of an output, relative to the largest of its state. Near singular postures Λ grows without bound,
# and the last digits of Λ⁻¹ decide its first ones.
AGREE = 1e-9
AGREE_NEAR_SINGULAR = 1e-5

# Method, and what it returns.
OPERATIONS = {
    "inverse_mass_matrix": "M⁻¹",
    "operational_inverse": "Λ⁻¹ of the last link",
    "operational_inertia": "Λ of the last link",
    "regressor": "Y of all bodies",
    "inverse_dynamics_along": "change of τ along a direction",
    "inverse_dynamics_adjoint": "lᵀ ∂τ/∂(q, v, a)",
    "forward_dynamics_along": "change of q̈ along a direction",
    "forward_dynamics_adjoint": "lᵀ ∂q̈/∂(q, v, τ)",
    "inverse_dynamics_curvature": "second derivatives of l·τ",
    "mass_matrix_rate": "Ṁ",
    "centre_of_mass": "c",
    "com_jacobian": "J of c",
    "centroidal_map": "A_g",
    "centroidal_momentum": "A_g v",
    "centroidal_bias": "Ȧ_g v",
}


def difference(mine, other):
    """The largest difference of an output, relative to the largest of its state. Outputs are compared in the order of
    their sizes: systems order parameters of a body, and parts of a wrench, in different ways."""
    worst = 0.0
    for a, b in zip(mine, other, strict=True):
        if len(a) != len(b):
            return float("inf")
        gaps = [abs(x - y) for x, y in zip(sorted(a), sorted(b))]
        # Written so that a NaN is a difference as well.
        fine = all(gap < float("inf") for gap in gaps)
        worst = max(worst, max(gaps) / max(map(abs, a)) if fine else float("inf"))
    return worst


def contenders(robot, operation):
    """Our program, and those of each column."""
    folder = DIR / "control" / robot
    flat = str(folder / f"{robot}.flat")
    libraries = [folder / f"control_{operation}.{compiler}.so" for compiler in COMPILERS]
    generated = [[str(DIR / "bin/control_generated"), flat, operation, str(x)] for x in libraries if x.exists()]
    pinocchio = [[str(DIR / "bin/control_pinocchio"), flat, operation]]
    return [str(DIR / "bin/control"), robot, operation], {"generated C": generated, "Pinocchio": pinocchio}


def measured(robot, operation):
    """Our time, and for each column the median of ours over the best program's; nothing where there is no such method."""
    ours, columns = contenders(robot, operation)
    if run(ours) is None:
        return None
    mine = outputs(ours)
    agree = AGREE_NEAR_SINGULAR if operation == "operational_inertia" else AGREE
    runs, worst = [], 0.0
    for column, commands in columns.items():
        for command in commands:
            if run(command) is None:
                continue
            gap = difference(mine, outputs(command))
            if gap > agree:
                sys.exit(f"{robot}, {operation}: {' '.join(command)} differs by {gap:.1e}, allowed are {agree:.0e}")
            worst = max(worst, gap)
            runs.append((column, command, []))
    own_times = []
    for _ in range(ROUNDS):
        for _, command, ratios in runs:
            own, other = run(ours)[0], run(command)[0]
            own_times.append(own)
            ratios.append(own / other)
    if not runs:
        sys.exit(f"{robot}, {operation}: nothing was compared")
    result = {"robot": robot, "operation": operation, "ours": statistics.median(own_times), "worst": worst, "columns": {}}
    for column, _, ratios in runs:
        ratio = statistics.median(ratios)
        if ratio > result["columns"].get(column, 0.0):
            result["columns"][column] = ratio
    shares = [f"{name} {ratio:.2f}" for name, ratio in result["columns"].items()]
    print(f"{robot} {operation}: {result['ours']:.1f} ns; over {', '.join(shares)}; outputs to {worst:.0e}", flush=True)
    return result


def cell(result, column, asked=None):
    ratio = result["columns"].get(column) if result else None
    if ratio is None:
        return "–"
    return f"**{ratio:.2f}**" if asked and ratio > asked else f"{ratio:.2f}"


def table(results, robots):
    """A row for each method, and three columns for each robot."""
    heads = ["method", ""]
    for robot in robots:
        heads += [f"{robot}, ns", "C", "Pinocchio"]
    rows = []
    for operation, what in OPERATIONS.items():
        row = [f"`{operation}`", what]
        for robot in robots:
            found = next((r for r in results if (r["robot"], r["operation"]) == (robot, operation)), None)
            row += [page.time(found["ours"]) if found else "–", cell(found, "generated C", ASKED), cell(found, "Pinocchio")]
        rows.append(row)
    return page.table(heads, rows)


def versions():
    pip = page.output(str(DIR / "venv/bin/pip"), "list", "--format=freeze")
    pip = dict(line.split("==") for line in pip.split() if "==" in line)
    clang = re.search(r"version ([0-9.]+)", page.output("clang-19", "--version"))
    gcc = page.output("gcc", "-dumpfullversion").strip()
    rustc = page.output("rustc", "--version").split()[1]
    return f"Pinocchio {pip['pin']}, CasADi {pip['casadi']}; rustc {rustc}, clang {clang.group(1)}, gcc {gcc}"


def text(results, specs):
    robots = [spec.stem for spec in specs]
    of_c = [r for r in results if "generated C" in r["columns"]]
    held = [r for r in of_c if r["columns"]["generated C"] <= ASKED]
    slower = [f"`{r['operation']}` of {r['robot']}" for r in of_c if r["columns"]["generated C"] >= 1.0]
    quiet = "with priority on one core (`chrt -f`, `taskset`)" if PREFIX else "without priority"
    quiet += f"; the load of the machine was {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    singular = max((r["worst"] for r in results if r["operation"] == "operational_inertia"), default=0.0)
    worst = max(r["worst"] for r in results if r["operation"] != "operational_inertia")
    places = [f"`{s.stem}` from [`{p}`](../{p})" for s in specs for p in [os.path.relpath(s.parent, ROOT)]]
    date, commit = datetime.date.today().isoformat(), page.output("git", "rev-parse", "--short", "HEAD").strip()
    notes = Path(__file__).with_name("notes.md")
    return f"""# Methods of controllers compared with other systems

{page.processor()}, {date}, commit `{commit}`. {versions()}. Written by `benches/peers/control/run.sh --docs`.

The measurement is that of [peers.md](peers.md): the same 1024 random states, {ROUNDS} rounds in turn, {quiet}. Columns are medians of **bgdyn's time over the peer's**: 0.25 means four times as fast. Before the timing, every output of 16 states was compared with each peer's: the largest difference is {worst:.0e} of the state's largest output (allowed {AGREE:.0e}). Λ is taken at the same states, some of which are near singular postures, where the last digits of Λ⁻¹ decide its first ones: {singular:.0e} (allowed {AGREE_NEAR_SINGULAR:.0e}).

- C is what CasADi generates from Pinocchio's algorithms over its expressions, with common subexpressions shared; directions, adjoints, Ṁ and second derivatives are CasADi's own derivatives of these. It is compiled by clang and by gcc with `-O3 -march=native`: the faster of both.
- Pinocchio is compiled from its headers, `-O3 -march=native`. It has no function for directions, adjoints, Λ and Ṁ: they are made of those that it has, such as all derivatives and their products with a vector.
- A dash: a link that fewer than six joints move has no Λ.
- Asked is at most {ASKED} of the time of C: {len(held)} of {len(of_c)} hold it, the others are bold.{f" Slower than C: {', '.join(slower)}." if slower else " None is slower than C."}

Arms: {'; '.join(places)}.

{table(results, robots)}
{notes.read_text() if notes.exists() else ""}""".rstrip() + "\n"


def main():
    specs = [Path(a) for a in sys.argv[1:] if not a.startswith("--")]
    target = ROOT / "docs" if "--docs" in sys.argv else DIR
    results = [measured(spec.stem, operation) for spec in specs for operation in OPERATIONS]
    results = [result for result in results if result]
    place = target / "peers_control.md"
    place.write_text(text(results, specs))
    print(f"wrote {place}")


if __name__ == "__main__":
    main()
