"""The numbers of the plot of results: for each robot and function, how many times as long as bgdyn each peer takes."""

import json
import subprocess

import page

OPERATIONS = {"inverse_dynamics": "inverse dynamics", "mass_matrix": "mass matrix", "forward_dynamics": "forward dynamics"}


def write(results, program, path):
    """Draws the plot by bin/plots, which is benches/peers/plots."""
    robots = {}
    for result in results:
        entries = [page.entry(result, columns) for columns in page.PEERS.values()]
        times = [1 / entry["ratio"] if entry else None for entry in entries]
        if name := OPERATIONS.get(result["operation"]):
            robots.setdefault(result["robot"], []).append((name, times))
    numbers = json.dumps({"systems": list(page.PEERS), "robots": list(robots.items())})
    subprocess.run([program, "ratios", path], input=numbers, text=True, check=True)
