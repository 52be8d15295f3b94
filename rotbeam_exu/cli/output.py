"""Printing: text that any terminal can show, and a table of columns, for a reader or as CSV."""

from __future__ import annotations

import codecs
import csv
import io
import math
import os
import sys
import time
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal, Protocol

from rich.cells import cell_len
from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress, ProgressColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

Format = Literal["table", "csv"]

_DIGITS = 7
"""Digits of a float in a table."""

_LINES = 50
"""Lines of progress printed about at most; a sweep of the paper's 24 cases prints each."""

_SPELLED = {
    "ω": "omega", "Ω": "Omega", "θ": "theta", "ϑ": "theta", "λ": "lambda", "μ": "mu", "η": "eta",
    "ν": "nu", "ρ": "rho", "κ": "kappa", "φ": "phi", "ψ": "psi", "π": "pi", "τ": "tau", "×": "x",
    "±": "+-", "²": "^2", "³": "^3", "⁴": "^4", "…": "...", "−": "-", "–": "-", "·": "*",
    "√": "sqrt ", "₀": "0",
}  # fmt: skip
"""Letters of the theory, for outputs that lack them."""
_CONTROL = {"Cc", "Cf", "Cs", "Zl", "Zp"}
"""Categories of letters that steer a terminal, or the direction in which it writes."""


class _Console(Console):
    """A console on which text from files does nothing but stand there."""

    def render_str(self, text: str, *rest: Any, **options: Any) -> Text:
        return super().render_str(harmless(text), *rest, **options)


def new_console(*, stderr: bool = False) -> Console:
    """Return a console that prints text as it is: no [markup], no :emoji:, no line broken."""
    return _Console(stderr=stderr, highlight=False, soft_wrap=True, markup=False, emoji=False)


def harmless(text: str) -> str:
    """Return a text, its control letters spelled as in Python: a terminal would obey them."""
    return "".join(
        repr(letter)[1:-1]
        if unicodedata.category(letter) in _CONTROL and letter not in "\n\t"
        else letter
        for letter in text
    )


def ready_streams() -> None:
    """Let standard output and error exist, and spell letters they cannot encode, omega for ω.

    On Windows a pipe and a file take the letters of one region only, as cp1252, which has no ω; in
    place of "omega_NL" and "lambda" a reader would find "?_NL" and "?".
    """
    # Closed ones, as by >&-, are None; a new file takes their number, which no other then gets.
    nowhere = Path(os.devnull)
    sys.stdout = sys.stdout or nowhere.open("w", encoding="utf-8")
    sys.stderr = sys.stderr or nowhere.open("w", encoding="utf-8")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="spelled")


def _spell(error: UnicodeError) -> tuple[str, int]:
    """Replace letters by their names, or by '?': the handler of an encoding error."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    letters = error.object[error.start : error.end]
    return "".join(_SPELLED.get(letter, "?") for letter in letters), error.end


codecs.register_error("spelled", _spell)


def print_columns(
    columns: Mapping[str, Sequence[str | float]],
    form: Format = "table",
    *,
    title: str = "",
    header: bool = True,
) -> None:
    """Print named columns of equal length; floats in full in CSV, to 7 digits in a table.

    Where a terminal is too narrow for the table, it comes in parts that repeat the first column;
    lines are broken between words only, never in a number. A CSV may go on without its `header`.
    """
    if form == "csv":
        writer = csv.writer(sys.stdout, lineterminator="\n")
        if header:
            writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
        return
    console = new_console()
    # Spelled before the widths are known, for what is spelled is longer.
    readable = {
        _encodable(name, console): [_encodable(cell, console) for cell in _cells(cells)]
        for name, cells in columns.items()
    }
    names, cells = list(readable), list(readable.values())
    least, most = (
        [
            max(cell_len(piece) for text in (name, *column) for piece in text.split(at) or [""])
            for name, column in readable.items()
        ]
        for at in (None, "\n")
    )
    if title:
        console.print(Text(title, style="italic"), soft_wrap=False)
    room = console.width
    for part in _parts(least, room):
        widths = _widths([least[i] for i in part], [most[i] for i in part], room)
        table = Table()
        for i, width in zip(part, widths, strict=True):
            justify: Any = "right" if all(map(_is_number, cells[i])) else "left"
            table.add_column(names[i], width=width, justify=justify)
        for row in zip(*(cells[i] for i in part), strict=True):
            table.add_row(*row)
        # Two columns at least: a longer line is better than half a number.
        console.width = max(room, _total(widths))
        console.print(table, soft_wrap=False)


def _total(widths: Sequence[int]) -> int:
    """Return the width of a table: three letters of frame and padding for each column."""
    return sum(widths) + 3 * len(widths) + 1


def _parts(least: Sequence[int], room: int) -> list[list[int]]:
    """Return the columns of each table, so that its longest words fit; the first is in each."""
    parts = [[0]]
    for column in range(1, len(least)):
        if len(parts[-1]) > 1 and _total([least[i] for i in [*parts[-1], column]]) > room:
            parts.append([0])
        parts[-1].append(column)
    return parts


def _widths(least: Sequence[int], most: Sequence[int], room: int) -> list[int]:
    """Return the columns' widths, with the widest texts narrowed for the table to fit.

    Rich does not know how long words are where it shrinks columns, and breaks numbers.
    """
    widths = list(most)
    while _total(widths) > room and widths != list(least):
        widths[max(range(len(widths)), key=lambda i: widths[i] - least[i])] -= 1
    return widths


def formatted(values: Iterable[float], form: str) -> list[str]:
    """Return numbers as text, and a dash where there is none."""
    return ["-" if math.isnan(value) else format(float(value), form) for value in values]


def print_text(text: str | Text, *, stderr: bool = False) -> None:
    """Print a sentence: broken between words on a terminal, in one line for what reads a file."""
    console = new_console(stderr=stderr)
    console.print(text, soft_wrap=not console.is_terminal)


def print_note(text: str) -> None:
    """Print a sentence below a table, in lines as wide as a table may be."""
    new_console().print(text, soft_wrap=False)


def print_line(title: str, text: str) -> None:
    """Print a title and its text beside it."""
    print_text(f"{title:<22}{text}")


def print_written(paths: Iterable[Path], *, stderr: bool = False) -> None:
    """Print the files written, one path a line."""
    for path in paths:
        new_console(stderr=stderr).print(f"written {path}")


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


def _encodable(text: str, console: Console) -> str:
    return harmless(text).encode(console.encoding, "spelled").decode(console.encoding)


class Drawn(Protocol):
    """A bar, called with the work done, all of it, and perhaps another title."""

    def __call__(self, done: float, whole: float, title: str | None = None, /) -> None:  # noqa: D102
        ...


@contextmanager
def bar(title: str, *more: ProgressColumn) -> Iterator[Drawn]:
    """Give a function to call with the work done and all of it; it draws on a terminal only."""
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
