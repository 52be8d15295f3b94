"""A blade from a file that names its sections: a CSV, or what BeamDyn, ElastoDyn or HAWC2 read."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from analytic import Blade

from .foreign import ForeignText
from .hawc2 import blade_of_htc, blade_of_st
from .openfast import blade_of_beamdyn, blade_of_elastodyn
from .stations_file import blade_of_csv


def _not_alone(path: Path) -> Blade:
    raise ValueError(
        f"{path} is the blade file of BeamDyn, which has no length: give the primary file, with "
        "the key points, that names it"
    )


_READERS: dict[str, Callable[[Path], Blade]] = {
    r"^\s*kp_xr\s": blade_of_beamdyn,
    r".*\sstation_total\b": _not_alone,
    r"^\s*BlFract\s": blade_of_elastodyn,
    r"^\s*begin\s+main_body\b": blade_of_htc,
    r"^\s*\$\s*\d+\s+\d+\b": blade_of_st,
}
"""Readers by a line that only their files have."""


def reader_of(path: Path) -> Callable[..., Blade] | None:
    """Return the reader of a file, by its content; none of TOML."""
    ending = path.suffix.lower()
    if ending in (".csv", ".toml"):
        return blade_of_csv if ending == ".csv" else None
    lines = ForeignText(path).lines
    for pattern, reader in _READERS.items():
        if any(re.match(pattern, line, re.IGNORECASE) for line in lines):
            return reader
    return None


def blade_of_file(path: Path, given: dict[str, Any]) -> Blade:
    """Return the blade of a file that [blade.stations] names, with what is `given` besides."""
    reader = reader_of(path) or blade_of_csv
    if given and reader is not blade_of_elastodyn:
        raise ValueError(
            f"{', '.join(given)} next to file are for a blade file of ElastoDyn, and {path} has "
            "them itself: leave them out"
        )
    return blade_by(reader, path, given)


def blade_by(reader: Callable[..., Blade], path: Path, given: dict[str, Any]) -> Blade:
    """Return what a reader makes of a file; every refusal names it."""
    try:
        return reader(path, **given)
    except (TypeError, ValueError) as error:
        text = str(error)
        raise ValueError(text if text.startswith(str(path)) else f"{path}: {text}") from error
