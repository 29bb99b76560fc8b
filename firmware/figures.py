"""Writes the tables of docs/embedded.md from what figures.sh measured: figures.py FOLDER PAGE."""

import sys
from pathlib import Path

CPUS = {"m4f": "Cortex-M4F", "m7": "Cortex-M7"}
ROBOTS = {"scara": "SCARA", "puma560": "PUMA 560", "panda": "Panda"}
FUNCTIONS = ["inverse dynamics", "mass matrix", "forward dynamics", "control step"]
OURS, LIBM, SAME = "generated", "textbook, sines of libm", "textbook, sines of bgdyn"
# Instructions in a period of 1 ms at 168 MHz, if each took one cycle.
PERIOD = 168_000


def read(path):
    """Lines `kind;robot;scalar;…` as {(kind, robot, scalar, …): numbers}."""
    found = {}
    for line in path.read_text().splitlines():
        kind, *rest = line.split(";")
        numbers = {"figure": 3, "flash": 1, "beyond": 2}[kind]
        found[(kind, *rest[:-numbers])] = [int(x) for x in rest[-numbers:]]
    return found


def number(x):
    return f"{x:,}"


def span(least, most):
    return number(least) if least == most else f"{number(least)}–{number(most)}"


def instructions(found, scalar):
    yield "| robot | function | generated | of 1 ms at 168 MHz | textbook, same sines | textbook, libm's sines |"
    yield "|---|---|---|---|---|---|"
    for robot, shown in ROBOTS.items():
        for function in FUNCTIONS:
            ours, same, libm = (
                found[("figure", robot, scalar, how, function)] for how in (OURS, SAME, LIBM)
            )
            share = f"{100 * ours[1] / PERIOD:.2g} %"
            row = [shown, function, f"**{span(*ours[:2])}**", share]
            row += [f"{span(*x[:2])} ({x[1] / ours[1]:.1f}×)" for x in (same, libm)]
            yield f"| {' | '.join(row)} |"


def memory(found):
    yield "| robot | function | flash f32 | textbook | stack f32 | textbook | flash f64 | textbook | stack f64 | textbook |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for robot, shown in ROBOTS.items():
        for function in [*FUNCTIONS, "all"]:
            row = [shown, "first three together" if function == "all" else function]
            for scalar in ("f32", "f64"):
                row += [number(found[("flash", robot, scalar, how, function)][0]) for how in (OURS, "textbook")]
                for how in (OURS, LIBM):
                    stack = found.get(("figure", robot, scalar, how, function))
                    row.append(number(stack[2]) if stack else "")
            yield f"| {' | '.join(row)} |"


def beyond(found):
    yield "| robot | f32: instructions | stack | f64: instructions | stack |"
    yield "|---|---|---|---|---|"
    for robot, shown in ROBOTS.items():
        numbers = found[("beyond", robot, "f32")] + found[("beyond", robot, "f64")]
        yield f"| {' | '.join([shown, *map(number, numbers)])} |"


def page(folder):
    compiler, emulator, commit = (folder / "versions.txt").read_text().splitlines()
    yield f"Measured at commit `{commit}` with {compiler} and {emulator}, `opt-level = 3`, fat LTO, one codegen unit."
    for cpu, shown in CPUS.items():
        found = read(folder / f"{cpu}.txt")
        for scalar in ("f32", "f64"):
            soft = ", computed in software" if (cpu, scalar) == ("m4f", "f64") else ""
            yield f"\n### {shown}, {scalar}{soft}: instructions a call\n"
            yield from instructions(found, scalar)
        yield f"\n### {shown}: flash and stack, bytes\n"
        yield from memory(found)
        yield f"\n### {shown}: inverse dynamics with an angle of 300,000 rad\n"
        yield from beyond(found)


def main():
    folder, path = Path(sys.argv[1]), Path(sys.argv[2])
    text = path.read_text()
    begin, end = "<!-- figures: begin -->\n", "<!-- figures: end -->"
    before, rest = text.split(begin)
    _, after = rest.split(end)
    path.write_text(before + begin + "\n".join(page(folder)) + "\n" + end + after)


main()
