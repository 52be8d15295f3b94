"""A beam from a TOML file."""

from __future__ import annotations

import difflib
import os
import tomllib
from dataclasses import fields
from pathlib import Path

from analytic import Beam

_MATERIAL = tuple(field.name for field in fields(Beam))
_STIFFNESS = ("length", "axial_stiffness", "bending_stiffness", "mass_per_length")


def load_beam(path: str | os.PathLike[str]) -> Beam:
    """Read a beam from the table [beam] of a TOML file, in SI units.

    The table gives length, area, second_moment, youngs_modulus and density, or length,
    axial_stiffness, bending_stiffness and mass_per_length.

    Raises
    ------
    ValueError
        If the file is not TOML, or a key is missing, unknown or has a value that is refused; the
        sentence names the file and the key.
    FileNotFoundError
        If there is no such file.
    """
    source = Path(path)
    if not source.is_file():
        raise FileNotFoundError(f"there is no file {source}")
    try:
        # Some editors begin a file with a byte order mark, which "utf-8-sig" skips.
        document = tomllib.loads(source.read_text(encoding="utf-8-sig"))
    except RecursionError as error:
        raise ValueError(f"{source} is not a beam: it is nested too deeply") from error
    except ValueError as error:  # of TOML, of UTF-8, or of an integer with too many digits
        raise ValueError(f"{source} is not valid TOML: {error}") from error
    for name in document:
        if name != "beam":
            raise ValueError(f"{source}: unknown table or key {name!r}; the beam is in [beam]")
    table = document.get("beam")
    if not isinstance(table, dict):
        raise ValueError(f"{source} has no table [beam] with {', '.join(_MATERIAL)}")
    by_stiffness = bool(set(table) & set(_STIFFNESS[1:]))
    wanted = _STIFFNESS if by_stiffness else _MATERIAL
    for key in table:
        if key not in wanted:
            close = difflib.get_close_matches(key, wanted, n=1)
            hint = f"did you mean {close[0]!r}?" if close else f"known are {', '.join(wanted)}"
            raise ValueError(f"{source}: unknown key {key!r} in [beam]; {hint}")
    missing = [key for key in wanted if key not in table]
    if missing:
        raise ValueError(f"{source}: [beam] lacks {', '.join(missing)}")
    try:
        return Beam.from_stiffness(**table) if by_stiffness else Beam(**table)
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: {error}") from error
