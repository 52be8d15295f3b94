"""Tables of a beam file: their keys, the sentence on a wrong one, and the JSON schema of all."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import NoneType
from typing import Literal, NamedTuple, get_args, get_origin, get_type_hints

from numpy.typing import ArrayLike

from analytic import Beam, Blade, Damping, LoadTable, PointMass, Section, Theory
from analytic.description import Described, kinds_of
from analytic.loads import Load
from analytic.parts import Line
from analytic.section_shapes import SectionShape

from ..runs import Element, Frame
from .openfast import blade_of_elastodyn


class Table(NamedTuple):
    """Keys of a table and the types of their values; a tuple of tables are alternatives."""

    required: Mapping[str, object]
    optional: Mapping[str, object]


def table_of(call: Callable[..., object]) -> Table:
    """Return the keys of a table that holds the fields of a class, or the arguments of a call."""
    hints, parameters = get_type_hints(call), inspect.signature(call).parameters.values()
    required = {one.name: hints[one.name] for one in parameters if one.default is one.empty}
    return Table(
        required, {one.name: hints[one.name] for one in parameters if one.name not in required}
    )


BEAM = Table(table_of(Beam).required, {"shape": SectionShape})
_SECTION = table_of(Section)
_SHAPED = Table(_SECTION.required, {**_SECTION.optional, "shape": SectionShape})
_STATIONS = (
    table_of(Blade.from_stations),
    table_of(Blade.from_shapes),
    Table({"file": str}, table_of(blade_of_elastodyn).optional),
)
_BLADE = {
    "hub_radius": float,
    "setting_angle": float,
    "point_mass": list[PointMass],
    "damping": (table_of(Damping), Table({"ratio": float | dict[str, float]}, {})),
    "line": table_of(Line),
}
NUMERICS = Table(
    {},
    {
        "element": Element, "elements": int, "step": float, "duration": float, "frame": Frame,
        "tolerance": float,
    },
)  # fmt: skip
THEORY = table_of(Theory)
_DOCUMENT = Table(
    {},
    {
        "beam": (BEAM, Table(dict.fromkeys(("length", *_SECTION.required), float), {})),
        "blade": (
            Table({"length": float, "section": _SHAPED}, _BLADE),
            Table({"stations": _STATIONS}, _BLADE),
        ),
        "motion": Table({}, {"omega": float, "ramp_time": float}),
        "theory": THEORY,
        "numerics": NUMERICS,
        "loads": list[Load],
        "uncertainty": dict[str, float],
    },
)


def require_keys(value: object, content: object = _DOCUMENT, title: str = "the file") -> None:
    """Refuse what is no table, missing keys, and unknown ones, in a table and in all within it."""
    if not (tables := _tables(content)):
        return
    if get_origin(content) in (list, Sequence):
        if not isinstance(value, list):
            raise ValueError(f"write each [{title}] as a table")
        for one in value:
            require_keys(one, tables, f"[{title}]")
        return
    if not isinstance(value, dict):
        named = isinstance(value, str) and any("file" in one.required for one in tables)
        raise ValueError(f"write {title} as a table" + f", file = {value!r} in it" * named)
    if _TELLING_ITS_KIND in tables:
        return
    # The one alternative whose keys are there.
    required, optional = min(
        tables, key=lambda one: (len(one.required.keys() - value), -len(one.required))
    )
    keys = {**required, **optional}
    for key, part in value.items():
        if key not in keys:
            close = difflib.get_close_matches(key, keys, n=1)
            hint = f"did you mean {close[0]!r}?" if close else f"known are {', '.join(keys)}"
            raise ValueError(f"unknown key {key!r} in {title}; {hint}")
        within = "" if content is _DOCUMENT else f"{title.strip('[]')}."
        require_keys(part, keys[key], f"[{within}{key}]")
    if missing := [key for key in required if key not in value]:
        raise ValueError(f"{title} lacks {', '.join(missing)}")


def _tables(content: object) -> tuple[Table, ...]:
    """Return the tables that a value of a type may be or hold, none of numbers and texts."""
    if isinstance(content, Table):
        return (content,)
    if isinstance(content, type) and issubclass(content, Described):
        return (table_of(content) if content.__name__ in kinds_of(content) else _TELLING_ITS_KIND,)
    parts = content if isinstance(content, tuple) else get_args(content)
    return tuple(table for one in parts for table in _tables(one))


_TELLING_ITS_KIND = Table({"kind": str}, {})
"""A table of a load or a shape, which `from_description` checks."""


def schema() -> dict[str, object]:
    """Return the JSON schema of a beam file, from the loader's own tables."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A beam or blade of rotbeam, and a run",
        **_schema_of(_DOCUMENT),
        "not": {"required": ["beam", "blade"]},
    }


_TYPES: dict[object, str | list[str]] = {
    float: "number", int: "integer", str: "string", bool: "boolean", ArrayLike: ["number", "array"],
}  # fmt: skip


def _schema_of(content: object) -> dict[str, object]:
    """Return the schema of a table, of alternatives, or of a value by its type hint."""
    if isinstance(content, Table):
        return {
            "type": "object",
            "properties": {
                k: _schema_of(v) for k, v in (*content.required.items(), *content.optional.items())
            },
            "required": list(content.required),
            "additionalProperties": False,
        }
    if get_origin(content) is Literal:
        return {"enum": list(get_args(content))}
    if get_origin(content) is dict:
        return {"type": "object", "additionalProperties": {"type": "number"}}
    if not isinstance(content, tuple) and content in _TYPES:
        return {"type": _TYPES[content]}
    parts: Iterable[object] = (
        content if isinstance(content, tuple) else dict.fromkeys(get_args(content))
    )
    if isinstance(content, type) and issubclass(content, Described):
        kinds = kinds_of(content)
        parts = (
            [table_of(content)] if content.__name__ in kinds else map(_with_kind, kinds.values())
        )
        if content is Load:
            keys = table_of(LoadTable)
            among = {
                k: of for k, of in keys.optional.items() if k not in ("force", "moment", "time")
            }
            parts = [*parts, Table({"kind": Literal["LoadTable"], "file": str}, among)]
    several: list[dict[str, object]] = [
        _schema_of(one) for one in parts if one not in (NoneType, Ellipsis)
    ]
    choice: dict[str, object] = several[0] if len(several) == 1 else {"anyOf": several}
    if get_origin(content) in (list, tuple, Sequence):
        return {"type": "array", "items": choice}
    return choice


def _with_kind(cls: type[object]) -> Table:
    """Return the keys of a table that names its kind."""
    keys = table_of(cls)
    return Table({"kind": Literal[cls.__name__], **keys.required}, keys.optional)
