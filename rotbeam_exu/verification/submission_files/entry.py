"""entry.toml: the author's declaration of a code, as `Declaration`, and back."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from analytic import Theory
from analytic.input_checks import positive
from analytic.theory import BERNOULLI_EULER

from ..cases import VERSION
from ..submission import Declaration
from .faults import Faults, near, shown, text_of

FILE = "entry.toml"
TAGS = ("shear", "rotary-inertia", "inextensible")
_TEXTS = ("benchmark", "code", "version", "url", "licence", "element", "machine", "remarks")
_ORDERS = ("order", "order_in_step")
_LAWS = ("Reissner", "Engesser")
_SHEAR_REMEDY = "[shear] takes k_s and nu, or share = k_s/(2 (1 + nu)), and perhaps a law"


def declaration_of(folder: Path, faults: Faults) -> Declaration | None:
    """Return what entry.toml declares; None if something is wrong with it."""
    text = text_of(folder, FILE, faults)
    if text is None:
        return None
    try:
        document = tomllib.loads(text)
    except (RecursionError, ValueError) as error:  # ValueError also of an integer without end
        faults.add(FILE, f"is not valid TOML: {error}")
        return None
    stated: dict[str, Any] = {}
    for key, value in document.items():
        try:
            if key not in _KEYS:
                raise ValueError(f"unknown key {shown(key)}; {near(key, _KEYS)}")
            stated[key] = _KEYS[key](key, value)
        except (TypeError, ValueError) as error:
            faults.add(FILE, str(error))
    for key, example in (("benchmark", VERSION), ("code", "name of your code")):
        if not str(document.get(key, "")).strip():
            faults.add(FILE, f'there is no {key}: write {key} = "{example}"')
    tags, theory = stated.pop("tags", ()), stated.pop("shear", BERNOULLI_EULER)
    if "shear" in tags and "shear" not in document:
        faults.add(FILE, f"the tag shear needs a table: {_SHEAR_REMEDY}")
    if faults.of(FILE):
        return None
    theory = replace(theory, rotary_inertia="rotary-inertia" in tags)
    return Declaration(**stated, theory=theory, inextensible="inextensible" in tags)


def entry_text(declaration: Declaration) -> str:
    """Return the text of entry.toml, from which the same declaration is read."""
    stated, theory = vars(declaration), declaration.theory
    lines = [f"benchmark = {_quoted(VERSION)}"]
    lines += [f"{key} = {_quoted(stated[key])}" for key in _TEXTS[1:] if stated[key]]
    if declaration.authors:
        lines.append(f"authors = [{', '.join(map(_quoted, declaration.authors))}]")
    lines += [f"{key} = {float(stated[key])!r}" for key in _ORDERS if stated[key] is not None]
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


def _text(key: str, value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"{key} must be text in quotes, got {shown(str(value))}")
    if key == "benchmark" and value and value.split(".")[0] != VERSION.split(".")[0]:
        raise ValueError(f"benchmark is {shown(value)}, this judge knows {VERSION}: see the kit")
    return value.strip()


def _list(key: str, value: Any) -> tuple[str, ...]:
    if not (isinstance(value, list) and all(isinstance(one, str) for one in value)):
        raise ValueError(f'{key} must be a list of texts, as {key} = ["...", "..."]')
    for tag in value if key == "tags" else ():
        if tag not in TAGS:
            raise ValueError(f"unknown tag {shown(tag)}; known are {', '.join(TAGS)}")
    return tuple(value)


def _shear(_key: str, value: Any) -> Theory:
    """Return the theory of a table of shear."""
    law = value.get("law", _LAWS[0]) if isinstance(value, dict) else None
    keys = sorted(set(value) - {"law"}) if isinstance(value, dict) else []
    if keys not in (["k_s", "nu"], ["share"]):
        raise ValueError(_SHEAR_REMEDY)
    if law not in _LAWS:
        raise ValueError(f"law must be {' or '.join(_LAWS)}, got {shown(str(law))}")
    if keys == ["share"]:
        share = positive("share", value["share"])
    else:
        nu = value["nu"]
        if not (isinstance(nu, int | float) and -1.0 < nu <= 0.5):
            raise ValueError(f"nu must be above -1 and at most 0.5, got {shown(str(nu))}")
        share = 0.5 * positive("k_s", value["k_s"]) / (1.0 + nu)
    return Theory(shear=share, engesser=law == "Engesser")


_KEYS: dict[str, Callable[[str, Any], Any]] = {
    **dict.fromkeys(_TEXTS, _text), "authors": _list, **dict.fromkeys(_ORDERS, positive),
    "tags": _list, "shear": _shear,
}  # fmt: skip
"""From a key and its value to the declared value; TypeError or ValueError with the sentence."""
