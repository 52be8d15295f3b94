"""Processes that work for us: they leave Ctrl-C to their parent and do not outlive it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager

from analytic.input_checks import whole_number


@contextmanager
def worker_pool(executor: Executor | None, jobs: int | None, most: int) -> Iterator[Executor]:
    """Give the caller's executor, left open, or our own spawned processes, closed at the end.

    Parameters
    ----------
    executor : concurrent.futures.Executor or None
    jobs : int or None
        Number of processes, by default the cores.
    most : int
        Number of pieces of work, more processes than which would idle.
    """
    if executor is not None:
        yield executor
        return
    cores = os.cpu_count() or 1
    workers = min(cores if jobs is None else whole_number("jobs", jobs), max(most, 1))
    spawn = multiprocessing.get_context("spawn")
    own = ProcessPoolExecutor(workers, mp_context=spawn, initializer=_obey_parent)
    try:
        yield own
    except BaseException:
        # Do not wait for what nobody asks for any more.
        for process in list(getattr(own, "_processes", None) or {}):
            own._processes[process].terminate()
        own.shutdown(wait=False, cancel_futures=True)
        raise
    own.shutdown()


def _obey_parent() -> None:
    """Leave Ctrl-C to the parent, and do not outlive it, should it be killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
