"""The numbers of the plot: error of each run over its time for a simulated second, or over its step where times were not measured."""

import json
import subprocess

SYSTEMS = ["bgdyn", "Pinocchio", "MuJoCo", "Drake"]
TITLES = {"parallelograms": "Two parallelograms: error, m", "five_bar": "Five-bar: error, rad"}


def write(rows, program, path):
    """Draws the plot by bin/plots, which is benches/peers/plots."""
    timed = any(r.get("seconds") for r in rows)
    run = lambda r: (SYSTEMS.index(r["system"]), r["seconds" if timed else "step"], r["error"], "Python" in r["inside"])
    runs = lambda name: [run(r) for r in rows if r["mechanism"] == name and r.get("error")]
    mechanisms = [(title, runs(name)) for name, title in TITLES.items()]
    numbers = json.dumps({"systems": SYSTEMS, "timed": timed, "mechanisms": mechanisms})
    subprocess.run([program, "errors", path], input=numbers, text=True, check=True)
