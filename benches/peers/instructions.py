"""What the compiled functions consist of: instructions by kind, and bytes.

    PEERS_DIR=target/peers python3 benches/peers/instructions.py [--clock GHZ]

Reads what run.sh --free has built: bgdyn's program and the C of CppADCodeGen by clang, for the machines with a floating
base. Each instruction that objdump prints is counted once: the code has no loops. The few for large angles, which are
rarely executed, are included; those of the sines that the C calls are not. With a clock, in GHz, it prints cycles of a
call, too.
"""

import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

DIR = Path(os.environ.get("PEERS_DIR", "target/peers"))
MACHINES = ["quadrotor_arm", "anymal_floating", "talos_reduced"]
OPERATIONS = ["inverse_dynamics", "mass_matrix", "forward_dynamics"]
ARITHMETIC = re.compile(r"v?(add|sub|mul|div|sqrt|fn?m(add|sub)\d*)[sp]d$")
KINDS = ["arithmetic", "kept values stored", "kept values read", "results and values stored", "constants and arguments read"]


def functions(path):
    """Name, bytes and instructions of each function."""
    text = subprocess.run(["objdump", "-d", "-C", "-w", str(path)], capture_output=True, text=True, check=True).stdout
    for block in re.split(r"\n(?=[0-9a-f]+ <)", text):
        head, _, body = block.partition(":\n")
        name = re.match(r"\s*[0-9a-f]+ <(.*)>$", head)
        if name:
            lines = [line.split("\t") for line in body.splitlines() if line.count("\t") >= 2]
            yield name[1], sum(len(line[1].split()) for line in lines), [line[2] for line in lines]


def kind(instruction):
    """The kind of an instruction; operands in memory count as arithmetic."""
    name, _, operands = instruction.split("#")[0].strip().partition(" ")
    if ARITHMETIC.match(name):
        return "arithmetic"
    if not name.startswith(("mov", "vmov", "vbroadcast")) or "(" not in operands:
        return "other"
    kept, written = "(%rsp" in operands, operands.rstrip().endswith(")")
    if written:
        return "kept values stored" if kept else "results and values stored"
    return "kept values read" if kept else "constants and arguments read"


def row(name, found):
    """The sums over some functions."""
    counts, size, number = Counter(), 0, 0
    for bytes_, instructions in found:
        counts.update(map(kind, instructions))
        size, number = size + bytes_, number + len(instructions)
    return f"| {name} | {size:,} | {number:,} | " + " | ".join(f"{counts[k]:,}" for k in KINDS) + " |"


def time(command):
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return float(done.stdout.split()[-2])


def main():
    clock = float(sys.argv[sys.argv.index("--clock") + 1]) if "--clock" in sys.argv else None
    ours = list(functions(DIR / "bin" / "ours"))
    print(f"| function | bytes | instructions | {' | '.join(KINDS)} |\n|" + " --- |" * (3 + len(KINDS)))
    for machine in MACHINES:
        for operation in OPERATIONS:
            of_machine = re.compile(rf"ours::{machine}::\w+<T>::{operation}(_block_\d+)?$")
            mine = [(size, body) for name, size, body in ours if of_machine.match(name)]
            # Those for states in lanes have packed arithmetic only; calls of blocks have none.
            packed = lambda body: any("mulpd" in i for i in body) and not any("mulsd" in i for i in body)
            mine = [f for f in mine if not packed(f[1])]
            print(row(f"bgdyn, {machine} {operation}", mine))
            folder = DIR / "robots" / machine
            library = folder / f"cppad_{operation}.clang-19.so"
            longest = max(functions(library), key=lambda f: f[1])
            print(row(f"C, {machine} {operation}", [longest[1:]]))
            if clock:
                mine = time([DIR / "bin" / "ours", machine, operation])
                other = time([DIR / "bin" / "generated", folder / f"{machine}.flat", operation, library])
                print(f"| | {mine * clock:,.0f} cycles beside {other * clock:,.0f} |" + " |" * (1 + len(KINDS)))


if __name__ == "__main__":
    main()
