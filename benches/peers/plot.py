"""The numbers of the plot of results: for each robot and function, how many times as long as bgdyn each peer takes."""

import json
import subprocess

import page

OPERATIONS = {"inverse_dynamics": "inverse dynamics", "mass_matrix": "mass matrix", "forward_dynamics": "forward dynamics"}


def times(result):
    entries = [page.entry(result, columns) for columns in page.PEERS.values()]
    return [1 / entry["ratio"] if entry else None for entry in entries]


def write(results, program, path):
    """Draws the plot by bin/plots, which is benches/peers/plots."""
    by_place = {(r["robot"], r["operation"]): r for r in results}
    robots = []
    for robot in dict.fromkeys(r["robot"] for r in results):
        found = {title: by_place.get((robot, operation)) for operation, title in OPERATIONS.items()}
        functions = [{"name": title, "times": times(result)} for title, result in found.items() if result]
        robots.append({"name": robot, "functions": functions})
    numbers = json.dumps({"peers": list(page.PEERS), "robots": robots})
    subprocess.run([program, "ratios", path], input=numbers, text=True, check=True)
