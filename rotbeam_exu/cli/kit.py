"""`rotbeam kit`: what an author of a code in any language needs to take part."""

from __future__ import annotations

from pathlib import Path

from ..verification.kit import write_kit
from .output import print_text


def kit(directory: Path, /) -> None:
    """Write the problem, its data and starters in five languages.

    Parameters
    ----------
    directory
        New, or empty.

    Examples
    --------
    $ rotbeam kit benchmark
    """
    folder = write_kit(directory)
    count = sum(path.is_file() for path in folder.rglob("*"))
    print_text(f"{count} files in {folder}; begin with README.md and PROBLEM.pdf")
