"""entry.toml: the author's declaration of a code, as `Declaration`, and back."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

from analytic import Theory
from analytic.input_checks import finite_number, positive

from ..cases import VERSION
from ..submission import Declaration
from .faults import LARGEST_TOML, Faults, near, shown, text_of

FILE = "entry.toml"
TAGS = ("shear", "rotary-inertia", "inextensible")
_TEXTS = ("benchmark", "code", "version", "url", "licence", "element", "machine", "remarks")
_ORDERS = ("order", "order_in_step")
_LAWS = ("Reissner", "Engesser")
_SHEAR_REMEDY = "[shear] takes k_s and nu, or share = k_s/(2 (1 + nu)), and perhaps a law"

Kind = Callable[[str, Any], Any]
"""From a key and its value to the declared value; ValueError with the sentences on a fault."""


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
    stated: dict[str, Any] = {}
    wrong = [(said, _line_of(key, text)) for key, said in _read(document, stated)]
    if faults.extend(FILE, wrong):
        return None
    tags, share = stated.pop("tags", ()), stated.pop("share", None)
    if "k_s" in stated:
        share = 0.5 * stated.pop("k_s") / (1.0 + stated.pop("nu"))
    slopes = stated.pop("law", "") == "Engesser"
    theory = Theory(shear=share, engesser=slopes, rotary_inertia="rotary-inertia" in tags)
    return Declaration(**stated, theory=theory, inextensible="inextensible" in tags)


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
        lines += ['law = "Engesser"'] * theory.engesser
    return "\n".join([*lines, ""])


def _quoted(text: str) -> str:
    # JSON's strings are TOML's but for DEL, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _read(document: dict[str, Any], stated: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Read the keys into `stated`; yield key and sentence of each fault."""
    for key, value, kinds in _items(document):
        try:
            if key not in kinds:
                raise ValueError(f"unknown key {shown(key)}; {near(key, kinds)}")
            stated[key] = kinds[key](key, value)
        except ValueError as error:
            for said in error.args:
                yield key, said
    for key, example in (("benchmark", VERSION), ("code", "name of your code")):
        if not str(document.get(key, "")).strip():
            yield key, f'there is no {key}: write {key} = "{example}"'
    tags = document.get("tags")
    if isinstance(tags, list) and "shear" in tags and "shear" not in document:
        yield "tags", f"the tag shear needs a table: {_SHEAR_REMEDY}"


def _items(document: dict[str, Any]) -> Iterator[tuple[str, Any, dict[str, Kind]]]:
    """Yield all keys, also of [shear], with their values and the kinds they may be of."""
    for key, value in document.items():
        table = key == "shear" and isinstance(value, dict)
        keys = sorted(set(value) - {"law"}) if table else []
        if keys in (["k_s", "nu"], ["share"]):
            yield from ((name, one, _SHEAR) for name, one in value.items())
        else:
            yield key, value, _KEYS


def _text(key: str, value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"{key} must be text in quotes, got {shown(str(value))}")
    if key == "benchmark" and value and value.split(".")[0] != VERSION.split(".")[0]:
        raise ValueError(f"benchmark is {shown(value)}, this judge knows {VERSION}: see the kit")
    return value.strip()


def _list(key: str, value: Any) -> tuple[str, ...]:
    listed, wrong = value if isinstance(value, list) else [value], []
    if listed is not value or not all(isinstance(one, str) for one in listed):
        wrong.append(f'{key} must be a list of texts, as {key} = ["...", "..."]')
    for tag in listed if key == "tags" else ():
        if isinstance(tag, str) and tag not in TAGS:
            wrong.append(f"unknown tag {shown(tag)}; known are {', '.join(TAGS)}")
    if wrong:
        raise ValueError(*wrong)
    return tuple(listed)


def _number(key: str, value: Any) -> float:
    if not isinstance(value, int | float):
        raise ValueError(f"{key} must be a number, got {shown(str(value))}")
    try:
        found = finite_number(key, value) if key == "nu" else positive(key, value)
    except TypeError as error:
        raise ValueError(str(error)) from error
    if key == "nu" and not -1.0 < found <= 0.5:
        raise ValueError(f"nu must be above -1 and at most 0.5, got {value:g}")
    return found


def _law(key: str, value: Any) -> str:
    if value not in _LAWS:
        raise ValueError(f"{key} must be {' or '.join(_LAWS)}, got {shown(str(value))}")
    return str(value)


def _no_shear(_key: str, _value: Any) -> None:
    raise ValueError(_SHEAR_REMEDY)


_KEYS: dict[str, Kind] = {
    **dict.fromkeys(_TEXTS, _text), "authors": _list, **dict.fromkeys(_ORDERS, _number),
    "tags": _list, "shear": _no_shear,
}  # fmt: skip
_SHEAR: dict[str, Kind] = {**dict.fromkeys(("k_s", "nu", "share"), _number), "law": _law}


def _line_of(key: str, text: str) -> int | None:
    """Return the line on which a key or a table stands."""
    name = re.escape(key)
    found = re.search(rf"^[ \t]*(\[+\s*)?[\"']?{name}[\"']?\s*[=.\]]", text, re.MULTILINE)
    return text.count("\n", 0, found.start()) + 1 if found else None
