"""What is wrong with a submission's files: all at once, each with its place and a remedy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Fault:
    """One fault of one file.

    Attributes
    ----------
    file : str
        Below the submission's folder, with slashes.
    said : str
        One sentence: what, where, what to do.
    line : int, optional
        In the file, the first being 1.
    """

    file: str
    said: str
    line: int | None = None

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return f"{place}: {self.said}"


class MalformedSubmissionError(ValueError):
    """A submission that cannot be judged before its files are mended.

    Attributes
    ----------
    faults : tuple of Fault
        All that were found, in the order of the files.
    """

    def __init__(self, faults: Sequence[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(map(str, self.faults)))


def several(count: int) -> str:
    """Return the end of a sentence on the first of `count` places that have the same fault."""
    return "" if count == 1 else f" (and so in {count - 1} more)"
