"""Computes the parts of a task in processes of this machine. The part of a process that dies is computed again.

The processes are started as ``python -m bgdyn._worker``, not by ``multiprocessing``: that would run the caller's script
once more in each of them, which a script without ``if __name__ == "__main__"`` and a notebook do not allow.
"""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Any

ATTEMPTS = 3
"""A part whose process dies so often is an error."""


def cores() -> int:
    """Returns the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def computed(compute: Callable[[Any], Any], parts: Sequence[Any], workers: int) -> Iterator[tuple[int, Any]]:
    """Yields index and result of each part, in the order in which they are finished.

    ``compute`` and the parts are pickled. An exception of ``compute`` is raised here.
    """
    todo: queue.SimpleQueue[tuple[int, int]] = queue.SimpleQueue()
    done: queue.SimpleQueue[tuple[int, Any, BaseException | None]] = queue.SimpleQueue()
    for index in range(len(parts)):
        todo.put((index, ATTEMPTS))
    pool = [_Worker(compute, parts, todo, done) for _ in range(min(workers, len(parts)))]
    try:
        for _ in parts:
            index, result, error = done.get()
            if error is not None:
                raise error
            yield index, result
    finally:
        for worker in pool:
            worker.stop()


class _Worker:
    """A process, and the thread that gives it parts; a process that died is replaced."""

    def __init__(self, compute: Any, parts: Sequence[Any], todo: Any, done: Any) -> None:
        self.compute, self.parts, self.todo, self.done = pickle.dumps(compute), parts, todo, done
        self.stopped = False
        self.process = self._new_process()
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _new_process(self) -> subprocess.Popen[bytes]:
        paths = os.pathsep.join(path for path in sys.path if path)
        return subprocess.Popen(
            [sys.executable, "-m", "bgdyn._worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": paths},
        )

    def _run(self) -> None:
        first = True
        while not self.stopped:
            try:
                index, attempts = self.todo.get(timeout=0.1)
            except queue.Empty:
                continue
            try:
                finished, result = self._asked(self.parts[index], first)
                first = False
                self.done.put((index, result, None) if finished else (index, None, result))
            except (OSError, EOFError, pickle.UnpicklingError):
                if self.stopped:
                    return
                first = True
                _ended(self.process)
                self.process = self._new_process()
                self._again(index, attempts - 1)
            except Exception as error:  # a part that cannot be pickled
                self.done.put((index, None, error))

    def _asked(self, part: Any, first: bool) -> tuple[bool, Any]:
        """Returns the answer of the process to a part; its first one follows the function."""
        to, answers = self.process.stdin, self.process.stdout
        assert to is not None and answers is not None
        if first:
            to.write(self.compute)
        to.write(pickle.dumps(part))
        to.flush()
        answer: tuple[bool, Any] = pickle.load(answers)
        return answer

    def _again(self, index: int, attempts: int) -> None:
        if attempts > 0:
            self.todo.put((index, attempts))
            return
        message = f"part {index} of {len(self.parts)} ended its process {ATTEMPTS} times: is there memory enough for it?"
        self.done.put((index, None, RuntimeError(message)))

    def stop(self) -> None:
        """Ends the process, which loses what it computes."""
        self.stopped = True
        self.process.kill()
        self.thread.join()
        _ended(self.process)


def _ended(process: subprocess.Popen[bytes]) -> None:
    """Waits for a process that was killed, and closes its pipes."""
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        try:
            if pipe is not None:
                pipe.close()
        except OSError:
            pass  # what was not written yet
