"""The study of study.py on Dask: two processes of this machine, or any cluster that Dask can reach.

    python on_dask.py [FOLDER] [--runs 1000000] [--workers 2]

Dask starts a worker anew that dies, and computes its parts again.
"""

from __future__ import annotations

from functools import partial
from itertools import islice

import bgdyn
from dask.distributed import Client, LocalCluster, as_completed
from study import Progress, Study, computed, main


def run(study: Study, scene: bgdyn.Scene, workers: int, progress: Progress) -> None:
    """Computes the parts that are left, and writes each one when it is finished."""
    left = study.left()
    total, waiting = study.parts(), iter(left)
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        # Few parts at a time: finished ones do not wait in memory.
        submit = partial(client.submit, computed, study, scene, pure=False)
        running = as_completed(map(submit, islice(waiting, 2 * workers)))
        for future in running:
            study.write(*future.result())
            progress(total - len(study.left()), total)
            for part in islice(waiting, 1):
                running.add(submit(part))


if __name__ == "__main__":
    main(run)
