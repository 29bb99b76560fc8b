"""The numbers of the figures: errors over steps, and errors over times for a simulated second, a panel for each case."""

import json
import math
import subprocess

from cases import CASES

# Names in the legend, colour and whether points are hollow.
SERIES = {
    ("bgdyn", "moreau"): ("bgdyn", 0, False),
    ("MuJoCo", "default"): ("MuJoCo, default", 2, True),
    ("MuJoCo", "stiff"): ("MuJoCo, stiff or spring", 2, False),
    ("Drake", "lagged"): ("Drake, lagged", 3, True),
    ("Drake", "sap"): ("Drake, near rigid or continuous", 3, False),
}
SAME = {
    ("bgdyn", "dopri5"): ("bgdyn", "moreau"),
    ("MuJoCo", "spring"): ("MuJoCo", "stiff"),
    ("Drake", "continuous"): ("Drake", "sap"),
    ("Drake", "spring"): ("Drake", "lagged"),
}
# Smaller errors are rounding, and drawn here.
LEAST = 1e-14


def panels(rows, along, of, scale):
    """A panel for each case; `along` is a key of a row."""
    keys = list(SERIES)
    for name, case in CASES.items():
        series = []
        for system, setting in dict.fromkeys((r["system"], r["setting"]) for r in rows if r["case"] == name):
            some = [r for r in rows if (r["case"], r["system"], r["setting"]) == (name, system, setting)]
            some = [r for r in some if along == "seconds" or not r["controlled"]]
            points = [(r[along] * scale, max(r["error"], LEAST)) for r in some if math.isfinite(r["error"])]
            key = (system, setting)
            if points:
                series.append((keys.index(SAME.get(key, key)), points))
        if len(series) > 1:
            unit = f", {case.unit}" if case.unit != "1" else ""
            yield {"title": case.title, "x": of, "y": f"error of the {case.of}{unit}", "series": series}


def write(rows, program, folder):
    """Draws by bin/plots, which is benches/peers/plots."""
    legend = list(SERIES.values())
    for file, along, of, scale in (
        ("peers_contact_steps", "given", "step, ms", 1e3),
        ("peers_contact_times", "seconds", "time for a simulated second, µs", 1e6),
    ):
        numbers = json.dumps({"legend": legend, "panels": list(panels(rows, along, of, scale))})
        subprocess.run([program, "curves", folder / f"{file}.svg"], input=numbers, text=True, check=True)
