"""One Exudyn system, silent, and gone at the end."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .lazily import exudyn


@contextmanager
def exudyn_system() -> Iterator[exudyn.MainSystem]:
    """Give an empty system; systems are not collected by themselves, and memory would grow."""
    exudyn.config.printToConsole = False
    # Without a display, an open renderer ends the process.
    exudyn.special.userInterface.suppressRenderer = True
    container = exudyn.SystemContainer()
    mbs = container.AddSystem()
    try:
        yield mbs
    finally:
        mbs.Reset()
        container.Reset()
