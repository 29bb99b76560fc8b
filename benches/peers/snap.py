"""What the default `snap` changes of the efforts of URDFs.

    python3 benches/peers/snap.py BGDYN FILE.urdf ...

Imports each file twice, as it is and with `--snap 0`, evaluates the literal sum of inverse dynamics at three random
states, and prints the largest difference, relative to the largest effort of the state.
"""

import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path


def run(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True)


def efforts(bgdyn, spec, states):
    done = run(bgdyn, "eval", spec, "inverse_dynamics", "--formulation", "literal", "--states", states)
    return json.loads(done.stdout)["results"] if done.returncode == 0 else None


def measured(bgdyn, urdf, folder):
    specs = []
    for name, options in (("default", []), ("kept", ["--snap", "0"])):
        spec = folder / f"{name}.yaml"
        made = run(bgdyn, "import", str(urdf), "-o", str(spec), *options)
        if made.returncode:
            return None, "not imported"
        specs.append(str(spec))
    report = json.loads(run(bgdyn, "check", "--json", specs[0]).stdout)
    if not report["ok"]:
        return None, "refused by check"
    model = report["model"]
    if model["nv"] == 0:
        return None, "no moving joint"
    random.seed(20)
    draw = lambda: [random.uniform(-2, 2) for _ in range(model["nv"])]
    states = folder / "states.json"
    states.write_text(json.dumps({"states": [{"q": draw(), "v": draw(), "a": draw()} for _ in range(3)]}))
    found = [efforts(bgdyn, spec, str(states)) for spec in specs]
    if None in found:
        return None, "not evaluated"
    worst = 0.0
    for one, other in zip(*found):
        size = max(map(abs, other), default=0.0)
        apart = max((abs(x - y) for x, y in zip(one, other)), default=0.0)
        worst = max(worst, apart / size if size else 0.0)
    return worst, model["snapped"]


def main():
    bgdyn, *files = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        for urdf in files:
            worst, said = measured(bgdyn, urdf, Path(folder))
            rows.append((worst, urdf, said))
    counted = [row for row in rows if row[0] is not None]
    for worst, urdf, said in sorted(counted, key=lambda row: -row[0]):
        told = "" if said is None else f"{said['count']} snapped, up to {said['most']:.1e} rad at {said['path']}"
        print(f"{worst:9.1e}  {Path(urdf).stem:40} {told}")
    for worst, urdf, said in rows:
        if worst is None:
            print(f"        -  {Path(urdf).stem:40} {said}")
    over = sum(worst > 1e-11 for worst, _, _ in counted)
    print(f"{len(counted)} measured, {sum(said is not None for _, _, said in counted)} snapped, {over} above 1e-11")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
