"""A Monte Carlo study: how far does a carriage press into its buffer, if nothing about it is known exactly?

A study is cut into parts. Each part draws its own random numbers, from the seed and its number, so that it has the same
results wherever and how often it is computed. Each finished part is a Parquet file of its own: memory does not grow, and
a study that was interrupted goes on where it ended.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import bgdyn

SCENE = Path(__file__).parent / "buffer.scene.yaml"

Columns = dict[str, np.ndarray[Any, Any]]
Progress = Callable[[int, int], Any]


@dataclass(frozen=True)
class Study:
    """Which runs there are, and where their results go."""

    folder: Path
    runs: int = 1_000_000
    part: int = 5_000
    seed: int = 2007

    def parts(self) -> int:
        """Returns the number of parts."""
        return -(-self.runs // self.part)

    def file(self, part: int) -> Path:
        """Returns the file with the results of a part."""
        return self.folder / f"part-{part:05}.parquet"

    def begin(self) -> None:
        """Writes which runs the study has into its folder, or goes on with it.

        Raises ``ValueError`` if the folder has another study: its parts would be taken for those of this one.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        file = self.folder / "study.json"
        own = {"runs": self.runs, "part": self.part, "seed": self.seed}
        if file.exists():
            there = json.loads(file.read_text())
            if there != own:
                raise ValueError(f"{self.folder} has a study of {there}, this one is of {own}: give another folder")
        elif any(self.folder.glob("part-*.parquet")):
            raise ValueError(f"{self.folder} has parts of a study, but no {file.name}: give another folder")
        else:
            file.write_text(json.dumps(own))

    def left(self) -> list[int]:
        """Returns the parts that have no file yet."""
        return [part for part in range(self.parts()) if not self.file(part).exists()]

    def values(self, part: int) -> list[dict[str, float]]:
        """Returns the random values of the runs of a part."""
        random = np.random.default_rng([self.seed, part])
        count = min(self.part, self.runs - part * self.part)
        drawn = {
            "mass": random.normal(40.0, 2.0, count),
            "stiffness": random.normal(20e3, 1.5e3, count),
            "damping": random.uniform(200.0, 400.0, count),
            "travel_rate": random.normal(1.0, 0.05, count),
        }
        return [dict(zip(drawn, row, strict=True)) for row in zip(*drawn.values(), strict=True)]

    def write(self, part: int, columns: Columns) -> None:
        """Writes the results of a part. Its file has its name only when it is whole."""
        self.folder.mkdir(parents=True, exist_ok=True)
        unfinished = self.file(part).with_suffix(".unfinished")
        pq.write_table(pa.table(columns), unfinished)
        os.replace(unfinished, self.file(part))

    def read(self, column: str) -> np.ndarray[Any, Any]:
        """Returns a column of all parts, in the order of the runs."""
        files = [self.file(part) for part in range(self.parts())]
        return np.concatenate([pq.read_table(file, columns=[column])[column].to_numpy() for file in files])


def computed(study: Study, scene: bgdyn.Scene, part: int) -> tuple[int, Columns]:
    """Computes a part: this is what a worker does. A scene that was sent to a process is prepared there once."""
    found = scene.sweep(study.values(part), workers=0, points=31, progress=False)
    return part, {
        **found.runs,
        "compression": found.high["travel"],
        "rebound": -found.low["travel_rate"],
        "failed": np.isin(np.arange(len(found)), list(found.failures)),
    }


def at_least_one(given: str) -> int:
    """Reads a number of runs or processes."""
    try:
        number = int(given)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1 on, not {given}")
    return number


def main(run: Callable[[Study, bgdyn.Scene, int, Progress], None]) -> None:
    """Runs the study of the command line, and prints time, memory and what was found."""
    options = argparse.ArgumentParser(description=SCENE.name)
    options.add_argument("folder", type=Path, nargs="?", default=Path("buffer_study"), help="where the results go")
    options.add_argument("--runs", type=at_least_one, default=Study.runs)
    options.add_argument("--workers", type=at_least_one, default=2, help="number of processes")
    given = options.parse_args()
    study, begin = Study(given.folder, given.runs), time.monotonic()
    try:
        study.begin()
    except ValueError as error:
        options.error(str(error))
    runs = min(study.runs, len(study.left()) * study.part)  # others have their files

    def line(done: int, total: int) -> None:
        passed = time.monotonic() - begin
        print(f"\r{done} of {total} parts, {passed:.0f} s", end="", flush=True)

    run(study, bgdyn.Scene(SCENE), given.workers, line)
    passed, memory = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    compression = 1e3 * study.read("compression")
    print(f"\n{passed:.1f} s, {passed / max(runs, 1) * 1e6:.1f} µs a run, at most {memory:.0f} MB in this process")
    print(f"compression: mean {compression.mean():.3f} mm, 99.9 % below {np.quantile(compression, 0.999):.3f} mm")
