"""Values by name: what files hold of blades, motions, loads and elements, and the values again.

A kind is a frozen dataclass that inherits from `Described`. From its definition on it is known by
the name of its class, so that a new one is a class in one place. Other classes are refused.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from typing import TypeVar

_KINDS: dict[str, type[Described]] = {}
_KIND = "kind"


class Described:
    """A value known by its kind and its fields; base of blades, motions, loads and elements.

    A class that others only build on is defined with ``abstract=True``.

    Raises
    ------
    TypeError
        If a class is defined whose name another kind has.
    """

    def __init_subclass__(cls, *, abstract: bool = False, **rest: object) -> None:
        super().__init_subclass__(**rest)
        if abstract:
            return
        namesake = _KINDS.get(cls.__name__, cls)
        # The same class may be defined anew, as where a module or a notebook's cell runs again.
        if _place(namesake) != _place(cls):
            raise TypeError(
                f"files know {_place(namesake)} by the name {cls.__name__}: give {_place(cls)} "
                "another one, or begin anew where it has moved"
            )
        _KINDS[cls.__name__] = cls

    def _keep(self, **checked: object) -> None:
        """Set fields, of a frozen dataclass too, to what checks have made of them."""
        for name, value in checked.items():
            object.__setattr__(self, name, value)


ValueT = TypeVar("ValueT")


def kinds_of(family: type[ValueT]) -> dict[str, type[ValueT]]:
    """Return the kinds that inherit from a class, by name, in the order of their definition."""
    return {name: cls for name, cls in _KINDS.items() if issubclass(cls, family)}


def describe(value: object) -> dict[str, object]:
    """Return kind and fields of a value as plain numbers, texts and lists; or refuse it."""
    cls, description = type(value), _described(value)
    try:
        whole = bool(from_description(json.loads(json.dumps(description)), cls) == value)
    except (TypeError, ValueError):
        whole = False
    if not whole:
        raise TypeError(
            f"no file can hold {value!r}: let the fields of {_place(cls)} be numbers, text, or "
            "tuples of them"
        )
    return description


def from_description(description: Mapping[str, object], family: type[ValueT]) -> ValueT:
    """Return the value that `describe` described; refuse one of no known kind of the family."""
    kind = description.get(_KIND)
    cls = kinds_of(family).get(str(kind))
    if cls is None:
        sort = "kind" if family is Described else family.__name__
        raise ValueError(f"{kind!r} is no known {sort}: import the module that defines it")
    values = {name: _value(part) for name, part in description.items() if name != _KIND}
    try:
        return cls(**values)
    except TypeError as error:
        raise ValueError(f"this is no {kind} as {_place(cls)} defines it: {error}") from error


def _described(value: object) -> dict[str, object]:
    cls = type(value)
    if _KINDS.get(cls.__name__) is not cls or "__dataclass_fields__" not in vars(cls):
        raise TypeError(
            f"no file can hold {value!r}: let {_place(cls)} be a frozen dataclass that inherits "
            "from one of the same sort, or from analytic.description.Described"
        )
    parts = ((field.name, getattr(value, field.name)) for field in fields(value) if field.init)  # type: ignore[arg-type]
    return {_KIND: cls.__name__, **{name: _plain(part) for name, part in parts}}


def _plain(part: object) -> object:
    if isinstance(part, Described):
        return _described(part)
    return list(map(_plain, part)) if isinstance(part, tuple | list) else part


def _value(part: object) -> object:
    if isinstance(part, Mapping):
        return from_description(part, Described)
    return tuple(map(_value, part)) if isinstance(part, list) else part


def _place(cls: type) -> str:
    return f"{cls.__module__}.{cls.__qualname__}"
