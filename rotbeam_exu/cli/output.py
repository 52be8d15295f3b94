"""Printing: text that any terminal can show, and a table of columns, for a reader or as CSV."""

from __future__ import annotations

import csv
import io
import math
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress, ProgressColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from analytic.letters import is_unseen

Format = Literal["table", "csv"]

_DIGITS = 7
"""Digits of a float in a table."""

_LINES = 50
"""Lines of progress printed about at most; a sweep of the paper's 24 cases prints each."""


class _Console(Console):
    """A console on which text from files does nothing but stand there."""

    def render_str(self, text: str, *rest: Any, **options: Any) -> Text:
        return super().render_str(harmless(text), *rest, **options)

    def on_broken_pipe(self) -> None:
        """Leave the exit code to `main`; rich's is 1."""
        raise BrokenPipeError


def new_console(*, stderr: bool = False) -> Console:
    """Return a console that prints text as it is: no [markup], no :emoji:, no line broken."""
    return _Console(stderr=stderr, highlight=False, soft_wrap=True, markup=False, emoji=False)


def harmless(text: str) -> str:
    """Return a text, its unseen letters spelled as in Python: a terminal would obey them."""
    return "".join(
        ascii(letter)[1:-1] if is_unseen(letter) and letter not in "\n\t" else letter
        for letter in text
    )


def write_utf8() -> None:
    """Let standard output and error write UTF-8, also to pipes and files of Windows."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8", errors="replace")


def print_columns(
    columns: Mapping[str, Sequence[str | float]],
    form: Format = "table",
    *,
    title: str = "",
) -> None:
    """Print named columns of equal length; floats in full in CSV, to 7 digits in a table."""
    if form == "csv":
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
        return
    table, texts = Table(), list(map(_cells, columns.values()))
    for name, cells in zip(columns, texts, strict=True):
        numbers = all(map(_is_number, cells))
        # Without these rich breaks words where it shrinks columns, or cuts the last column off.
        words = " ".join([name, *cells]).split()
        table.add_column(
            name, justify="right" if numbers else "left", min_width=max(map(len, words), default=0),
            no_wrap=all(" " not in one for one in (name, *cells)),
        )  # fmt: skip
    for row in zip(*texts, strict=True):
        table.add_row(*row)
    console = new_console()
    if title:
        console.print(Text(title, style="italic"), soft_wrap=False)
    for padding in ((0, 1), (0, 0)):
        table.padding = padding
        with console.capture() as drawn:
            console.print(table, crop=False)
        # Its measure is of narrower columns than it draws.
        if max(map(len, drawn.get().splitlines())) <= console.width:
            break
    console.print(table, crop=False)


def formatted(values: Iterable[float], form: str) -> list[str]:
    """Return numbers as text, and a dash where there is none."""
    return ["-" if math.isnan(value) else format(float(value), form) for value in values]


def print_text(text: str | Text, *, stderr: bool = False) -> None:
    """Print a sentence: broken between words on a terminal, in one line for what reads a file."""
    console = new_console(stderr=stderr)
    console.print(text, soft_wrap=not console.is_terminal)


def print_message(title: str, style: str, text: str) -> None:
    """Print a sentence after its title on standard error."""
    text = harmless(" ".join(text.split()))
    print_text(Text.assemble((title, style), " ", text), stderr=True)


def print_note(text: str) -> None:
    """Print a sentence below a table, in lines as wide as a table may be."""
    new_console().print(text, soft_wrap=False)


def print_line(title: str, text: str) -> None:
    """Print a title and its text."""
    print_text(f"{title:<22}{text}")


def print_written(paths: Iterable[Path]) -> None:
    """Print the files written, one path a line."""
    for path in paths:
        new_console().print(f"written {path}")


def _cells(column: Sequence[str | float]) -> list[str]:
    """Return the cells of a column as text; of floats to 7 digits, zeros at the end where needed.

    Where one has six decimals, 3.73033 is written 3.730330: its zero is known, not missing.
    """
    texts = [_cell(cell) for cell in column]
    decimals = [len(text.partition(".")[2]) for text in texts if "e" not in text]
    most = max(decimals, default=0)
    return [
        text
        if isinstance(cell, str) or cell == 0.0 or not math.isfinite(cell) or "e" in text
        else f"{cell:.{min(most, max(0, _DIGITS - 1 - math.floor(math.log10(abs(cell)))))}f}"
        for cell, text in zip(column, texts, strict=True)
    ]


def _cell(cell: str | float) -> str:
    if isinstance(cell, float) and math.isnan(cell):
        return "-"
    return f"{cell:.{_DIGITS}g}" if isinstance(cell, float) else str(cell)


def _is_number(text: str) -> bool:
    try:
        float(text.rstrip("! "))
    except ValueError:
        return text in {"", "-", "failed"}
    return True


@contextmanager
def bar(title: str, *more: ProgressColumn) -> Iterator[Callable[..., None]]:
    """Give a function to call with the work done, all of it, and perhaps another title.

    It draws on a terminal only.
    """
    console = new_console()
    with Progress(
        *Progress.get_default_columns(), *more, TimeElapsedColumn(), console=console,
        transient=True, disable=not console.is_terminal,
    ) as drawn:  # fmt: skip
        task = drawn.add_task(title, total=None)
        yield lambda done, whole, title=None: drawn.update(
            task, completed=done, total=whole, description=title
        )


@contextmanager
def counter(title: str) -> Iterator[Callable[[int, int], None]]:
    """Give a function to call with the pieces done and their number.

    Without a terminal its lines go to standard error: results stay alone on standard output.
    """
    errors, started = new_console(stderr=True), time.monotonic()

    def line(done: int, number: int) -> None:
        if done % -(-number // _LINES) == 0 or done == number:
            after = time.monotonic() - started
            errors.print(f"{title}: {done} of {number} done after {after:.0f} s")

    with bar(title, MofNCompleteColumn()) as drawn:
        yield drawn if new_console().is_terminal else line
