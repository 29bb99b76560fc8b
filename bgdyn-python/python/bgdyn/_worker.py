"""What a worker process of `_workers.py` runs: it computes one part after the other until its input ends."""

from __future__ import annotations

import os
import pickle
import signal
import sys
from typing import Any


def main() -> None:
    """Reads a function and then arguments from the input, pickled; writes whether each was computed, and the result."""
    # Ctrl-C in a terminal reaches all processes: the one that started this one ends it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parts, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    # What a function prints shall not come between the answers.
    os.dup2(2, 1)
    compute = pickle.load(parts)
    while True:
        try:
            part = pickle.load(parts)
        except EOFError:
            return
        answer: tuple[bool, Any]
        try:
            answer = True, compute(part)
        except Exception as error:
            answer = False, error
        pickle.dump(answer, answers)
        answers.flush()


if __name__ == "__main__":
    main()
