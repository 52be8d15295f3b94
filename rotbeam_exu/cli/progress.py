"""How far a long command is: a bar on a terminal, a plain line per finished piece elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from .output import new_console

T = TypeVar("T")

_LINES = 50
"""About so many are printed at most; a sweep of the paper's 24 cases prints each."""


@contextmanager
def counter(console: Console, title: str) -> Iterator[Callable[[int, int], None]]:
    """Give what is called with the pieces done and their number.

    Without a terminal its lines go to standard error: results stay alone on standard output.
    """
    if not console.is_terminal:
        yield _plain(title)
        return
    with Progress(
        *Progress.get_default_columns(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn(""),
        console=console,
        transient=True,
    ) as bar:
        task = bar.add_task(title, total=None)

        def progress(done: int, number: int) -> None:
            bar.update(task, completed=done, total=number)

        yield progress


def counted(console: Console, title: str, pieces: Iterable[T], number: int) -> Iterator[T]:
    """Yield each piece of work, and count it when the next one is asked for."""
    with counter(console, title) as progress:
        for done, piece in enumerate(pieces, start=1):
            yield piece
            progress(done, number)


def _plain(title: str) -> Callable[[int, int], None]:
    errors, started = new_console(stderr=True), time.monotonic()

    def progress(done: int, number: int) -> None:
        if done % -(-number // _LINES) and done != number:
            return
        errors.print(f"{title}: {done} of {number} done after {time.monotonic() - started:.0f} s")

    return progress
