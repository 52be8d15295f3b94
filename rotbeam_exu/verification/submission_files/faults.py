"""Files of a submission, and their faults: all at once, each with its place and a remedy.

A judge must not follow links out of a stranger's folder, or read pipes and devices. So all files
are read here: regular ones below the folder, up to a limit.
"""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from ..submission import Submission

_VARIES = re.compile(
    r"'(?:\\.|[^'\\])*'|\"(?:\\.|[^\"\\])*\"|[-+]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?"
)
"""Parts that vary between sentences of one kind: quotations from a file, and numbers."""

_SHOWN = 40
"""Letters of a faulty cell that a sentence repeats."""

LARGEST = 100_000_000
"""Bytes of a file that is read; a history of a million samples has less."""

OUTSIDE = "is a link that leads out of the folder: put what it names in its place"


@dataclass(frozen=True, kw_only=True)
class Fault:
    """A sentence on one file below the folder, and the line in it, the first being 1."""

    file: str
    said: str
    line: int | None = None

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return f"{place}: {self.said}"


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


class Folder:
    """The folder of a submission, and the faults that are found in it."""

    def __init__(self, root: str | os.PathLike[str]) -> None:
        self.root = Path(root)
        self._alike: dict[tuple[str, str], list[Fault]] = {}

    def add(self, file: str, said: str, line: int | None = None) -> None:
        """Keep a fault; sentences of one kind differ in numbers and quotations only."""
        fault = Fault(file=file, said=said, line=line)
        self._alike.setdefault((_VARIES.sub("#", said), file), []).append(fault)

    def add_all(self, file: str, faults: Iterable[tuple[str, int | None]]) -> bool:
        """Keep faults with their lines, and return whether there are any."""
        kept = list(faults)
        for said, line in kept:
            self.add(file, said, line)
        return bool(kept)

    @property
    def faults(self) -> tuple[Fault, ...]:
        """The first of each kind in a file, in the order found, with the count of others."""
        return tuple(
            replace(first, said=first.said + several(1 + len(others)))
            for first, *others in self._alike.values()
        )

    def is_faulty(self, file: str) -> bool:
        """Return whether a file has a fault."""
        return any(file == other for _, other in self._alike)

    def real(self, name: str) -> Path | None:
        """Return the place to which links lead; None if it is not below the folder."""
        path = Path(os.path.realpath(self.root / name))
        return path if path.is_relative_to(os.path.realpath(self.root)) else None

    def histories(self, name: str) -> list[str]:
        """Return the CSV files of a folder below this one, as S1/m032_h1e-3.csv."""
        paths = sorted((self.root / name).glob("*.csv")) if self.real(name) else []
        return [f"{name}/{printable(path.name)}" for path in paths]

    def content(self, file: str) -> bytes:
        """Return the bytes of a regular file; OSError or ValueError with what keeps it unread."""
        path = self.real(file)
        if path is None:
            raise ValueError(OUTSIDE)
        if path.exists() and not path.is_file():
            raise ValueError("is a folder, a pipe or a device: put a file in its place")
        with path.open("rb") as opened:
            content = opened.read(LARGEST + 1)
        if len(content) > LARGEST:
            many = f"has more than {LARGEST:,} bytes"
            raise ValueError(f"{many}: hand in what the kit asks for, and sample less often")
        return content

    def text(self, file: str) -> str | None:
        """Return the text of a file, its lines ended by LF; None, and why, where it is no text."""
        try:
            # Some editors begin a file with a byte order mark, which "utf-8-sig" skips.
            text = self.content(file).decode("utf-8-sig")
            if "\0" not in text:
                return text.replace("\r\n", "\n").replace("\r", "\n")
            said = "is not text (it holds zero bytes): write it as UTF-8"
        except UnicodeDecodeError as error:
            said = f"is not text (byte {error.start} is no UTF-8): write it as UTF-8"
        except FileNotFoundError:
            said = "there is no such file"
        except OSError as error:
            said = f"cannot be read: {error.strerror or error}"
        except ValueError as error:
            said = str(error)
        self.add(file, said)
        return None


def several(count: int) -> str:
    """Return the end of a sentence on the first of `count` places that have the same fault."""
    return "" if count == 1 else f" (and so in {count - 1:,} more)"


def shown(text: str) -> str:
    """Return a text in quotes, what cannot be printed escaped, and not too much of it."""
    quoted = ascii(text) if not text.isprintable() else repr(text)
    return quoted if len(quoted) <= _SHOWN else f"{quoted[:_SHOWN]}...{quoted[0]}"


def near(name: str, names: Iterable[str], shown_as: Callable[[str], str] = repr) -> str:
    """Return the end of a sentence on an unknown name: the most similar known name, or all."""
    alike = {one.lower(): one for one in names}
    for close in difflib.get_close_matches(name.lower(), alike, n=1):
        return f"did you mean {shown_as(alike[close])}?"
    begun = [shown_as(one) for key, one in alike.items() if name and key.startswith(name.lower())]
    if begun:
        return f"did you mean {' or '.join(begun)}?"
    return f"known are {', '.join(alike.values())}"


def printable(name: str) -> str:
    """Return the name of a file, bytes that are no letters and the like replaced."""
    text = name.encode("utf-8", "replace").decode()
    return text if text.isprintable() else ascii(text)[1:-1]
