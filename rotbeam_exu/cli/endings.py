"""Warnings and the end of a command on standard error: sentences, and no leavings."""

from __future__ import annotations

import errno
import os
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache

from rich.text import Text

from .output import harmless, print_text

_STOPPING = [
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)
]  # Windows has no SIGHUP

_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}

_LONGEST = 60
"""Letters of a warning that are repeated where others like it are counted."""


@contextmanager
def stopped_as_by_ctrl_c() -> Iterator[list[int]]:
    """Take SIGTERM and SIGHUP as Ctrl-C, which removes temporaries; give the list of those met.

    The first one counts: a terminal that is closed may send several. A signal that is ignored, as
    by nohup, stays ignored.
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


@contextmanager
def telling_what_is_kept(kept: Callable[[], str]) -> Iterator[None]:
    """Let Ctrl-C name the files that stay: `kept` returns them, or an empty text."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        told = [str(interrupt)] if interrupt.args else []  # by a part of the work inside this one
        raise KeyboardInterrupt("; ".join(filter(None, [kept(), *told]))) from None


def output_is_lost() -> bool:
    """Return whether standard output takes no more; Python's exit must not write to it again."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return True
    return False


def sentence_on(error: OSError) -> str:
    """Return the sentence on a file: its name, the fault, and the remedy."""
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


@lru_cache
def _varies() -> re.Pattern[str]:
    """Return what may differ between two warnings of a kind: numbers, and names of models."""
    from analytic import VARIANTS

    names = "|".join(sorted(VARIANTS, key=len, reverse=True))
    return re.compile(rf"(?<!\w)(?:{names})(?!\w)|[+-]?\d+\.?\d*(?:e[+-]?\d+)?")


class Messages:
    """Messages of one command on standard error.

    Warnings that differ only in their numbers, or in the model they are about, are one: the first
    is printed at once, and how many followed at the end.
    """

    def __init__(self) -> None:
        # The texts of each kind once, in order: several of our functions may notice the same.
        self._met: dict[str, dict[str, None]] = {}

    def say(self, title: str, style: str, text: str) -> None:
        """Print a sentence in one line after its title."""
        text = harmless(" ".join(text.split()))
        print_text(Text.assemble((title, style), " ", text), stderr=True)

    def warn(self, message: Warning | str, *_: object) -> None:
        """Print a warning, or count it: what `warnings.showwarning` takes."""
        text = " ".join(str(message).split())
        alike = self._met.setdefault(_varies().sub("#", text), {})
        if not alike:
            self.say("warning:", "yellow", text)
        alike[text] = None

    def count(self) -> None:
        """Say how many warnings were not printed."""
        for first, *more in self._met.values():
            begin = first if len(first) <= _LONGEST else f"{first[:_LONGEST].rsplit(' ', 1)[0]} ..."
            if more:
                text = f"{len(more)} more like it, with other numbers: {begin}"
                self.say("warning:", "yellow", text)
        self._met.clear()
