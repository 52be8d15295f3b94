"""Where cases run: processes of our own, or a Dask cluster."""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

from analytic.input_checks import whole_number

_PATIENCE = 5.0  # s


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


def dask_executor(scheduler: str) -> tuple[Executor, Any]:
    """Return an executor on a Dask cluster, and the client to close after use.

    Parameters
    ----------
    scheduler : str
        Address of the scheduler, as "tcp://host:8786".

    Raises
    ------
    ImportError
        If Dask is not installed.
    OSError
        If the scheduler does not answer within five seconds.
    """
    try:
        from distributed import Client  # noqa: PLC0415  (an extra)
    except ImportError as error:
        raise ImportError(
            "Dask is not installed; install the extra: pip install '.[cluster]' in a clone"
        ) from error
    try:
        client: Any = Client(scheduler, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise OSError(
            f"the scheduler {scheduler} does not answer within {_PATIENCE:g} s: check its address "
            "and that it runs"
        ) from error
    # Of a scheduler that ends it logs a traceback; the sweep says it in a sentence.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    return client.get_executor(), client
