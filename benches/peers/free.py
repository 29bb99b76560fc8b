"""The part of the page about machines with a floating base: ratios beside what is asked."""

import datetime
import json
import os
import re
from pathlib import Path

import page

TITLE = "## Joints of several degrees of freedom"
OPERATIONS = ["inverse_dynamics", "mass_matrix", "forward_dynamics"]
# bgdyn's time over the peer's, at most.
ASKED = {
    "generated C": {"inverse_dynamics": 0.35, "mass_matrix": 0.35, "forward_dynamics": 0.30},
    "Pinocchio": dict.fromkeys(OPERATIONS, 0.20),
}
# Largest difference of an output, relative to the largest of its state.
AGREE = 1e-10


def share(entry):
    least, most = entry["spread"]
    return f"{entry['ratio']:.2f} ({least:.2f}–{most:.2f})"


def row(result, folder):
    cells, missed = [], []
    for peer, asked in ASKED.items():
        found = page.entry(result, page.PEERS[peer])
        limit = asked[result["operation"]]
        cells += [share(found) if found else "–", f"{limit:.2f}"]
        if not found:
            missed.append(f"{peer}: nothing compared")
        elif found["ratio"] > limit:
            missed.append(peer)
    missed = f"**missed: {', '.join(missed)}**" if missed else "held"
    own, other = counts(result, folder)
    share_of_c = f"{own:,} / {other:,} = {own / other:.2f}" if other else f"{own:,}"
    return [result["robot"], page.function(result), page.time(result["ours"]), *cells, missed, share_of_c]


def flat(folder, robot):
    return (folder / "robots" / robot / f"{robot}.flat").read_text().splitlines()[3:]


def velocities(folder, robot):
    return sum(6 if " floating " in line else 1 for line in flat(folder, robot))


def origin(spec):
    """Where a machine is from: this repository, or the package of robots."""
    if spec.startswith(".."):
        return "from the Python package example-robot-data 6.0.0, by `bgdyn import --base floating`"
    return f"from [`{Path(spec).parent}`](../{Path(spec).parent})"


def counts(result, folder):
    """Additions, multiplications and divisions of bgdyn's function, and those in the text of the fastest C."""
    counted = json.loads((folder / "robots" / result["robot"] / "operations.json").read_text())["functions"]
    own = counted[result["operation"]]
    fastest = page.entry(result, page.PEERS["generated C"])
    own = own["add"] + own["mul"] + own["div"]
    if not fastest:
        return own, 0
    library = Path(fastest["command"][-1])
    return own, operations_of_c((library.parent / f"{library.name.split('.')[0]}.c").read_text())


def operations_of_c(text):
    """Those between two operands of its assignments, and CasADi's squares; signs and exponents are none."""
    assignments = [line for line in text.splitlines() if re.match(r"\s*\w+(\[\d+\])? ?=", line)]
    body = re.sub(r"\d[eE][-+]", "0", "\n".join(assignments))
    return len(re.findall(r"[\w\])] ?[-+*/] ?[\w(-]", body)) + body.count("casadi_sq(")


def summary(results):
    """What was held and what was missed, in numbers."""
    lines = []
    for peer, asked in ASKED.items():
        found = [(r, page.entry(r, page.PEERS[peer])) for r in results]
        held = [e for r, e in found if e and e["ratio"] <= asked[r["operation"]]]
        lines.append(f"{len(held)} of {len(results)} beside {peer}")
    return f"Held: {', '.join(lines)}."


def reasons(results, folder):
    """Why bars are missed, as far as the counts show it."""
    shares, slower = [], []
    for result in results:
        own, other = counts(result, folder)
        if other:
            shares.append(own / other)
            if page.entry(result, page.PEERS["generated C"])["ratio"] > own / other:
                slower.append(f"{result['robot']}'s {page.function(result)}")
    if not shares:
        return ""
    return (
        f"Why the others are missed: bgdyn's functions have {min(shares):.2f} to {max(shares):.2f} of the operations of the C, "
        "and for a ratio below that an operation has to take less time, too. In most functions it takes less, but not enough. "
        f"It takes more in {', '.join(slower) or 'none'}. Mass matrices compute little for each number that they write: both "
        "programs write all entries, 64 of `quadrotor_arm` beside 78 operations. Pinocchio writes the upper triangle only, "
        "half as many numbers."
    )


def section(results, rounds, undisturbed, folder):
    date = datetime.date.today().isoformat()
    commit = page.output("git", "rev-parse", "--short", "HEAD").strip()
    load = os.getloadavg()[0]
    quiet = "with priority on one core (`chrt -f`, `taskset`)" if undisturbed else "without priority"
    worst = max(r["difference"] for r in results)
    heads = ["machine", "function", "bgdyn, ns", "over generated C", "asked", "over Pinocchio", "asked", "", "operations, bgdyn / C"]
    machines = dict.fromkeys((r["robot"], r["spec"]) for r in results)
    origins = "; ".join(f"`{robot}` ({velocities(folder, robot)} velocities) {origin(spec)}" for robot, spec in machines)
    return f"""{TITLE}

{page.machine()}, {date}, commit `{commit}`. {page.versions(folder)}. Written by `benches/peers/run.sh --free --docs`.

The states are those above, of a floating joint positions within ±0.3 m and any orientation. q, v, a and τ of a floating joint are the same for bgdyn and for Pinocchio's free flyer ([conventions](conventions.md)). Before the timing, every output of 16 states was compared with each peer's: the largest difference is {worst:.0e} of the state's largest output (allowed {AGREE:.0e}). Ratios are medians of {rounds} rounds in turn, {quiet}, with the least and the largest in brackets; other programs ran at the same time (load {load:.1f} on {os.cpu_count()} cores). Generated C is the fastest of CasADi's and CppADCodeGen's, by clang and, up to 12 velocities, by gcc. Operations are those written in the text of the function: additions, multiplications and divisions, of bgdyn and of the fastest C.

Machines: {origins}.

{page.table(heads, [row(r, folder) for r in results])}
{summary(results)} {reasons(results, folder)}

{(Path(__file__).parent / "where_the_time_goes.md").read_text()}"""


def put(text, part):
    """The page with this part in the place of the one it has, or at its end."""
    before, found, after = text.partition(TITLE)
    _, next_part, rest = after.partition("\n## ")
    end = f"\n{next_part.lstrip()}{rest}" if found and next_part else ""
    return before.rstrip() + "\n\n" + part.rstrip() + "\n" + end
