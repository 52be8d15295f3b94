"""How a command ends that is stopped, or cannot write: without leavings, and with a sentence."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_STOPPING = [
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)
]  # Windows has no SIGHUP

_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


@contextmanager
def stopped_as_by_ctrl_c() -> Iterator[list[int]]:
    """Take SIGTERM and SIGHUP as Ctrl-C, which removes temporaries; give the list of those met.

    The first one counts: a terminal that is closed may send several. What is ignored, as by nohup,
    stays ignored.
    """
    met: list[int] = []

    def stop(number: int, frame: object) -> None:
        if not met:
            met.append(number)
            raise KeyboardInterrupt

    ours = []
    if threading.current_thread() is threading.main_thread():
        ours = [one for one in _STOPPING if signal.getsignal(one) == signal.SIG_DFL]
    for one in ours:
        signal.signal(one, stop)
    try:
        yield met
    finally:
        for one in ours:
            signal.signal(one, signal.SIG_DFL)


def output_is_lost() -> bool:
    """Return whether standard output takes no more; Python's exit must not write to it again."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return True
    return False


def sentence_on(error: OSError) -> str:
    """Return which file it is, what is the matter, and what to do."""
    if output_is_lost():
        return f"cannot write to standard output: {error.strerror}; send it elsewhere"
    if error.errno in _FULL:
        # All other files are named where they are written.
        name = error.filename or "to standard output, or a temporary file"
        return f"cannot write {name}: {error.strerror}; make room, or write elsewhere"
    if error.errno is None or error.filename is None:
        return str(error)  # most likely a sentence of ours
    return (
        f"{error.filename}: {error.strerror}; check that it is there, and who may read and write it"
    )
