"""Faults of a submission's files: all at once, each with its place and a remedy."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ..submission import Submission

_VARIES = re.compile(
    r"'(?:\\.|[^'\\])*'|\"(?:\\.|[^\"\\])*\"|[-+]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?"
)
"""Parts that vary between sentences of one kind: quotations from a file, and numbers."""

_MOST_FILES = 10
"""Files in which a fault of one kind is told for each; faults in others are counted."""

_SHOWN = 40
"""Letters of a faulty cell that a sentence repeats."""


@dataclass(frozen=True, kw_only=True)
class Fault:
    """A sentence on one file below the folder, and the line in it, the first being 1."""

    file: str
    said: str
    line: int | None = None

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return f"{place}: {self.said}"


class Faults:
    """Faults as they are found: the first of a kind in a file, and how many more there are.

    Sentences of one kind differ in numbers and quotations only.
    """

    def __init__(self) -> None:
        self._first: dict[tuple[str, str], Fault] = {}
        self._count: Counter[tuple[str, str]] = Counter()
        self._files: dict[str, list[str]] = {}

    def __bool__(self) -> bool:
        return bool(self._first)

    def add(self, file: str, said: str, line: int | None = None) -> None:
        """Keep a fault, or count it."""
        kind = _VARIES.sub("#", said)
        files = self._files.setdefault(kind, [])
        if file not in files and len(files) < _MOST_FILES:
            files.append(file)
        key = kind, file if file in files else files[-1]
        self._first.setdefault(key, Fault(file=file, said=said, line=line))
        self._count[key] += 1

    def extend(self, file: str, found: Iterable[tuple[str, int | None]]) -> bool:
        """Keep faults of one file, each with its line, and return whether there are any."""
        several = list(found)
        for said, line in several:
            self.add(file, said, line)
        return bool(several)

    def of(self, file: str) -> bool:
        """Return whether a file has one."""
        return any(fault.file == file for fault in self._first.values())

    def told(self) -> tuple[Fault, ...]:
        """Return the first of each kind, in the order found, with the count of those alike."""
        return tuple(
            replace(fault, said=fault.said + several(self._count[key]))
            for key, fault in self._first.items()
        )


class MalformedSubmissionError(ValueError):
    """A submission whose files are to be mended.

    Attributes
    ----------
    faults : tuple of Fault
        One of each kind in a file, with the count of those alike, in the order of the files.
    rest : Submission or None
        The files and rows without faults, where there are any.
    """

    def __init__(self, faults: Iterable[Fault], rest: Submission | None = None) -> None:
        self.faults, self.rest = tuple(faults), rest
        super().__init__("\n".join(map(str, self.faults)))


def several(count: int) -> str:
    """Return the end of a sentence on the first of `count` places that have the same fault."""
    return "" if count == 1 else f" (and so in {count - 1:,} more)"


def shown(text: str) -> str:
    """Return a text in quotes, what cannot be printed escaped, and not too much of it."""
    quoted = ascii(text) if not text.isprintable() else repr(text)
    return quoted if len(quoted) <= _SHOWN else f"{quoted[:_SHOWN]}...{quoted[0]}"


def near(name: str, known: Iterable[str], told: Callable[[str], str] = repr) -> str:
    """Return the end of a sentence on an unknown name: the most similar known name, or all."""
    alike = {one.lower(): one for one in known}
    close = difflib.get_close_matches(name.lower(), alike, n=1)
    return (
        f"did you mean {told(alike[close[0]])}?"
        if close
        else f"known are {', '.join(alike.values())}"
    )


def printable(name: str) -> str:
    """Return the name of a file, bytes that are no letters and the like replaced."""
    text = name.encode("utf-8", "replace").decode()
    return text if text.isprintable() else ascii(text)[1:-1]
