"""The study of study.py on joblib: processes of this machine, or what joblib has a backend for.

    python on_joblib.py [FOLDER] [--runs 1000000] [--workers 2]

joblib ends a call if a worker dies. The parts that were finished have their files; the others are computed by the next
call.
"""

from __future__ import annotations

import bgdyn
from joblib import Parallel, delayed
from joblib.externals.loky.process_executor import BrokenProcessPool
from study import Progress, Study, computed, main


def run(study: Study, scene: bgdyn.Scene, workers: int, progress: Progress) -> None:
    """Computes the parts that are left, and writes each one when it is finished."""
    while left := study.left():
        calls = (delayed(computed)(study, scene, part) for part in left)
        try:
            for part, columns in Parallel(n_jobs=workers, return_as="generator_unordered")(calls):
                study.write(part, columns)
                progress(study.parts() - len(study.left()), study.parts())
        except BrokenProcessPool:
            if len(study.left()) == len(left):
                raise  # no part was finished: another try would end in the same way


if __name__ == "__main__":
    main(run)
