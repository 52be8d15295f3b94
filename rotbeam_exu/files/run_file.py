"""A run from a TOML file: its beam, and its motion and numerics where it holds them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from analytic import AnyBlade, Beam
from analytic.input_checks import positive, rotation_speed, whole_number

from .beam_file import beam_from, read_toml, require_keys

_MOTION: dict[str, Callable[[Any], Any]] = {
    "omega": rotation_speed,
    "ramp_time": lambda value: positive("ramp_time", value, "s"),
}
_NUMERICS: dict[str, Callable[[Any], Any]] = {
    "element": lambda value: _text("element", value),
    "elements": lambda value: whole_number("elements", value),
    "step": lambda value: positive("step", value, "s"),
    "duration": lambda value: positive("duration", value, "s"),
    "frame": lambda value: _text("frame", value),
}


@dataclass(frozen=True, kw_only=True)
class RunFile:
    """What a file says of a run.

    Attributes
    ----------
    beam : Beam or Blade
        The paper's beam, where the file has none.
    motion : dict
        Of `omega` [rad/s] and `ramp_time` [s] those that the file holds.
    numerics : dict
        Of `element`, `elements`, `step` [s], `duration` [s] and `frame` those that it holds.
    """

    beam: AnyBlade
    motion: Mapping[str, float] = field(default_factory=dict)
    numerics: Mapping[str, Any] = field(default_factory=dict)


def load_run_file(path: str | os.PathLike[str]) -> RunFile:
    """Read [beam] or [blade], as `load_beam` does, and the tables [motion] and [numerics].

    [motion] may hold omega [rad/s] and ramp_time [s]; [numerics] element, elements, step [s],
    duration [s] and frame. A file with one of these may do without a beam.

    Raises
    ------
    ValueError
        If `load_beam` refuses the file, or a key is unknown or has a value that is refused; the
        sentence names the file and the key.
    FileNotFoundError
        If there is no such file.
    """
    source = Path(path)
    document = read_toml(source)
    tables = {
        name: _checked(document.pop(name), f"[{name}]", source, checks)
        for name, checks in (("motion", _MOTION), ("numerics", _NUMERICS))
        if name in document
    }
    beam = beam_from(document, source) if document or not tables else Beam.reference()
    return RunFile(beam=beam, **tables)


def _checked(
    table: Any, title: str, source: Path, checks: dict[str, Callable[[Any], Any]]
) -> dict[str, Any]:
    if not isinstance(table, dict):
        raise ValueError(f"{source}: write {title} as a table")
    require_keys(table, title, source, (), tuple(checks))
    try:
        return {name: checks[name](value) for name, value in table.items()}
    except (OverflowError, TypeError, ValueError) as error:
        raise ValueError(f"{source}: {title}: {error}") from error


def _text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a name in quotes, got {value!r}")
    return value
