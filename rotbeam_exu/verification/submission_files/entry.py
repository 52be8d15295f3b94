"""entry.toml: the author's declaration of a code, as `Declaration`, and back."""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace
from typing import Any

from analytic import Theory
from analytic.input_checks import finite_number, positive
from analytic.theory import BERNOULLI_EULER

from ..cases import VERSION
from ..submission import ORDERS, TEXTS, Declaration, declared
from .faults import Folder, near, shown

FILE = "entry.toml"
TAGS = ("shear", "rotary-inertia", "inextensible")
_KEYS = (*TEXTS, "authors", *ORDERS, "tags", "shear")
_LAWS = ("Reissner", "Engesser")
_SHARES = 1e-3, 10.0
_SHEAR_REMEDY = "[shear] takes k_s and nu, or share = k_s/(2 (1 + nu)), and perhaps a law"


def declaration_of(folder: Folder) -> Declaration | None:
    """Return what entry.toml declares; None if something is wrong with it."""
    text = folder.text(FILE)
    if text is None:
        return None
    try:
        document = tomllib.loads(text)
    except (RecursionError, ValueError) as error:  # ValueError also of an integer without end
        folder.add(FILE, f"is not valid TOML: {error}")
        return None
    stated: dict[str, Any] = {}
    for key, value in document.items():
        try:
            stated[key] = _stated(key, value)
        except (TypeError, ValueError) as error:
            folder.add(FILE, str(error))
    for key, example in (("benchmark", VERSION), ("code", "name of your code")):
        if not str(document.get(key, "")).strip():
            folder.add(FILE, f'there is no {key}: write {key} = "{example}"')
    tags, theory = stated.pop("tags", ()), stated.pop("shear", BERNOULLI_EULER)
    if "shear" in tags and "shear" not in document:
        folder.add(FILE, f"the tag shear needs a table: {_SHEAR_REMEDY}")
    if folder.is_faulty(FILE):
        return None
    theory = replace(theory, rotary_inertia="rotary-inertia" in tags)
    return Declaration(**stated, theory=theory, inextensible="inextensible" in tags)


def _stated(key: str, value: object) -> object:
    """Return the declared value of a key; TypeError or ValueError with the sentence."""
    if key not in _KEYS:
        raise ValueError(f"unknown key {shown(key)}; {near(key, _KEYS)}")
    if key == "shear":
        return _sheared(value)
    if key == "tags":
        return _tags(value)
    value = value.strip() if isinstance(value, str) else value
    if key == "benchmark" and value and str(value).split(".")[0] != VERSION.split(".")[0]:
        raise ValueError(
            f"benchmark is {shown(str(value))}, this judge knows {VERSION}: see the kit"
        )
    return declared(key, value)


def _tags(value: object) -> tuple[str, ...]:
    """Return the tags."""
    if not (isinstance(value, list) and all(isinstance(one, str) for one in value)):
        raise ValueError('tags must be a list of texts, as tags = ["...", "..."]')
    for tag in value:
        if tag not in TAGS:
            raise ValueError(f"unknown tag {shown(tag)}; known are {', '.join(TAGS)}")
    return tuple(value)


def _sheared(stated: object) -> Theory:
    """Return the theory of the table [shear]."""
    rest = dict(stated) if isinstance(stated, dict) else {}
    law = rest.pop("law", _LAWS[0])
    if rest.keys() not in ({"k_s", "nu"}, {"share"}):
        raise ValueError(_SHEAR_REMEDY)
    if law not in _LAWS:
        raise ValueError(f"law must be {' or '.join(_LAWS)}, got {shown(str(law))}")
    if "share" in rest:
        share = positive("share", rest["share"])
    else:
        nu = finite_number("nu", rest["nu"])
        if not -1.0 < nu <= 0.5:
            raise ValueError(f"nu must be above -1 and at most 0.5, got {nu:g}")
        share = 0.5 * positive("k_s", rest["k_s"]) / (1.0 + nu)
    if not _SHARES[0] <= share <= _SHARES[1]:
        raise ValueError(
            f"share = {share:g} is no beam's, it must be from {_SHARES[0]:g} to {_SHARES[1]:g}"
        )
    return Theory(shear=share, engesser=law == "Engesser")


def entry_text(declaration: Declaration) -> str:
    """Return the text of entry.toml, from which the same declaration is read."""
    stated, theory = vars(declaration), declaration.theory
    lines = [f"benchmark = {_quoted(VERSION)}"]
    lines += [f"{key} = {_quoted(stated[key])}" for key in TEXTS[1:] if stated[key]]
    if declaration.authors:
        lines.append(f"authors = [{', '.join(map(_quoted, declaration.authors))}]")
    lines += [f"{key} = {float(stated[key])!r}" for key in ORDERS if stated[key] is not None]
    held = (theory.shear is not None, theory.rotary_inertia, declaration.inextensible)
    tags = [_quoted(tag) for tag, there in zip(TAGS, held, strict=True) if there]
    lines.append(f"tags = [{', '.join(tags)}]")
    if theory.shear is not None:
        lines += ["", "[shear]", f"share = {float(theory.shear)!r}"]
        lines += ['law = "Engesser"'] * theory.engesser
    return "\n".join([*lines, ""])


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)  # a declaration has no DEL, which TOML escapes
