"""entry.toml: what the author says of a code, as `Declaration`, and back."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

from analytic import Theory
from analytic.input_checks import finite_number, positive

from ..cases import VERSION
from ..submission import Declaration
from .content import LARGEST_TOML, text_of
from .faults import Faults, near, shown

FILE = "entry.toml"
TAGS = ("shear", "rotary-inertia", "inextensible")
_TEXTS = ("benchmark", "code", "version", "url", "licence", "element", "machine", "remarks")
_ORDERS = ("order", "order_in_step")
_SHEAR_REMEDY = "[shear] takes k_s and nu, or share = k_s/(2 (1 + nu))"
_Faults = Iterator[tuple[str, str]]
"""The key and the sentence of each fault."""


def declaration_of(folder: Path, faults: Faults) -> Declaration | None:
    """Return what entry.toml declares; None if something is wrong with it."""
    text = text_of(folder, FILE, faults, LARGEST_TOML)
    if text is None:
        return None
    try:
        document = tomllib.loads(text)
    except RecursionError:
        faults.add(FILE, "is nested too deeply: keep to the keys of the kit")
        return None
    except ValueError as error:  # of TOML, or of an integer with too many digits
        place = re.search(r"at line (\d+)", str(error))
        faults.add(FILE, f"is not valid TOML: {error}", int(place[1]) if place else None)
        return None
    said = list(_wrong_with(document))
    for key, why in said:
        faults.add(FILE, why, _line_of(key, text))
    if said:
        return None
    tags = document.get("tags", [])
    stated: dict[str, Any] = {key: document[key].strip() for key in _TEXTS if key in document}
    stated |= {key: float(document[key]) for key in _ORDERS if key in document}
    return Declaration(
        **stated,
        authors=tuple(document.get("authors", ())),
        theory=_theory(tags, document.get("shear")),
        inextensible="inextensible" in tags,
    )


def entry_text(declaration: Declaration) -> str:
    """Return the text of entry.toml, from which the same declaration is read."""
    stated = {field.name: getattr(declaration, field.name) for field in fields(Declaration)}
    lines = [f"benchmark = {_quoted(VERSION)}"]
    lines += [f"{key} = {_quoted(stated[key])}" for key in _TEXTS[1:] if stated[key]]
    if declaration.authors:
        lines.append(f"authors = [{', '.join(map(_quoted, declaration.authors))}]")
    lines += [f"{key} = {float(stated[key])!r}" for key in _ORDERS if stated[key] is not None]
    theory = declaration.theory
    held = (theory.shear is not None, theory.rotary_inertia, declaration.inextensible)
    tags = [_quoted(tag) for tag, there in zip(TAGS, held, strict=True) if there]
    lines.append(f"tags = [{', '.join(tags)}]")
    if theory.shear is not None:
        lines += ["", "[shear]", f"share = {float(theory.shear)!r}"]
    return "\n".join([*lines, ""])


def _quoted(text: str) -> str:
    # JSON's strings are TOML's but for DEL, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _theory(tags: Iterable[str], shear: dict[str, float] | None) -> Theory:
    share = None
    if shear is not None:
        share = shear["share"] if "share" in shear else 0.5 * shear["k_s"] / (1.0 + shear["nu"])
    rotary = "rotary-inertia" in tags
    return Theory(rotary_inertia=rotary, shear=share)


def _wrong_with(document: dict[str, Any]) -> _Faults:
    """Yield what is wrong with the keys, and which are missing."""
    for key, value in document.items():
        if key in _KEYS:
            yield from _KEYS[key](key, value)
        else:
            yield key, f"unknown key {shown(key)}; {near(key, _KEYS)}"
    for key, example in (("benchmark", VERSION), ("code", "name of your code")):
        if not str(document.get(key, "")).strip():
            yield key, f'there is no {key}: write {key} = "{example}"'
    tags = document.get("tags")
    if isinstance(tags, list) and "shear" in tags and "shear" not in document:
        yield "tags", f"the tag shear needs a table: {_SHEAR_REMEDY}"


def _wrong_text(key: str, value: object) -> _Faults:
    if not isinstance(value, str):
        yield key, f"{key} must be text in quotes, got {shown(str(value))}"
    elif key == "benchmark" and value not in ("", VERSION):
        yield key, f"benchmark is {shown(value)}, this judge knows {VERSION}: see the kit"


def _wrong_list(key: str, value: object) -> _Faults:
    listed = value if isinstance(value, list) else [value]
    if listed is not value or not all(isinstance(one, str) for one in listed):
        yield key, f'{key} must be a list of texts, as {key} = ["...", "..."]'
    for tag in listed if key == "tags" else ():
        if isinstance(tag, str) and tag not in TAGS:
            yield key, f"unknown tag {shown(tag)}; known are {', '.join(TAGS)}"


def _wrong_number(key: str, value: object) -> _Faults:
    try:
        if not isinstance(value, int | float):
            raise TypeError(f"{key} must be a number, got {shown(str(value))}")
        finite_number(key, value) if key == "nu" else positive(key, value)
    except (TypeError, ValueError) as error:
        yield key, str(error)
    else:
        if key == "nu" and not -1.0 < value <= 0.5:
            yield key, f"nu must be above -1 and at most 0.5, got {value:g}"


def _wrong_shear(key: str, value: object) -> _Faults:
    if isinstance(value, dict) and sorted(value) in (["k_s", "nu"], ["share"]):
        for name, number in value.items():
            yield from _wrong_number(name, number)
    else:
        yield key, _SHEAR_REMEDY


_KEYS: dict[str, Callable[[str, object], _Faults]] = {
    **dict.fromkeys(_TEXTS, _wrong_text), "authors": _wrong_list,
    **dict.fromkeys(_ORDERS, _wrong_number), "tags": _wrong_list, "shear": _wrong_shear,
}  # fmt: skip


def _line_of(key: str, text: str) -> int | None:
    """Return the line on which a key or a table stands."""
    name = re.escape(key)
    found = re.search(rf"^[ \t]*(\[+\s*)?[\"']?{name}[\"']?\s*[=.\]]", text, re.MULTILINE)
    return text.count("\n", 0, found.start()) + 1 if found else None
