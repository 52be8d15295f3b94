"""A blade as the TOML file that `load_beam` reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from textwrap import fill
from typing import Any

from analytic import Beam, Blade


def blade_toml(blade: Blade, **others: Any) -> str:
    """Return the text of a TOML file with a blade, every digit of it, and other tables or values.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu.files.blade_toml import blade_toml
    >>> print(blade_toml(Beam.reference(), motion={"omega": 6.0}))
    [motion]
    omega = 6.0
    <BLANKLINE>
    [beam]
    length = 8.0
    area = 7.299e-05
    second_moment = 8.214e-09
    youngs_modulus = 68950000000.0
    density = 2767.0
    <BLANKLINE>
    """
    if isinstance(blade, Beam):
        main = {"beam": _changed(blade)}
    else:
        parts = _changed(blade)
        for name, key in (("point_masses", "point_mass"), ("section", "stations")):
            if name in parts and (name != "section" or blade.table):
                parts[key] = parts.pop(name)
        if "stations" in parts:
            del parts["length"]
        main = {"blade": parts}
    tables = {name: _plain(other) for name, other in others.items()}
    return "\n".join(_lines({k: v for k, v in (tables | main).items() if v}, ())) + "\n"


def _changed(value: Any) -> dict[str, Any]:
    """Return the fields of a value that are not their defaults, those within as tables."""
    given = ((one, getattr(value, one.name)) for one in fields(value) if one.init)
    return {
        one.name: _plain(part) for one, part in given if part is not None and part != one.default
    }


def _plain(part: Any) -> Any:
    if is_dataclass(part):
        return _changed(part)
    if isinstance(part, tuple) and part and is_dataclass(part[0]):
        return list(map(_changed, part))
    return part


def _lines(table: Mapping[str, Any], title: tuple[str, ...]) -> list[str]:
    """Return a table's values, then the tables within it."""
    lines = [f"{k} = {_written(v)}" for k, v in table.items() if not isinstance(v, (dict, list))]
    for key, part in table.items():
        name = ".".join((*title, key))
        for one in part if isinstance(part, list) else [part] * isinstance(part, dict):
            header = f"[[{name}]]" if isinstance(part, list) else f"[{name}]"
            lines += [*[""] * bool(lines), header, *_lines(one, (*title, key))]
    return lines


def _written(value: Any) -> str:
    """Return a number, a text or nested numbers as TOML has them, a row of numbers a line."""
    if not isinstance(value, tuple):
        return str(value).lower() if isinstance(value, bool) else repr(value).replace("'", '"')
    text = ", ".join(map(_written, value))
    if value and isinstance(value[0], tuple):
        return "[\n" + "".join(f"{_written(one)},\n" for one in value) + "]"
    return fill(f"[{text}]", 100, break_long_words=False, break_on_hyphens=False)
