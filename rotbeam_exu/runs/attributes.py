"""The attributes by which a run says its beam, motion, loads and versions."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from importlib import metadata
from typing import Any

from analytic import Blade, SpinUp, SteadyRotation
from analytic.description import describe, from_description
from analytic.loads import Load
from analytic.motion import Motion
from analytic.theory import BERNOULLI_EULER, Theory

from .. import __version__

Attributes = Mapping[Any, Any]
"""Attributes of a Dataset, which have no types."""

_UNKNOWN = "unknown: what is out of the plane of bending is not computed, and zero"


def beam_of(attrs: Attributes) -> Blade:
    """Return the blade that the attributes of a run describe."""
    return from_description(json.loads(attrs["blade"]), Blade)


def blade_attributes(blade: Blade) -> dict[str, object]:
    """Return the attributes by which a run says which blade it is; `beam_of` reads them.

    They say too if the section out of the plane of bending is not known.
    """
    remark = {} if blade.section.knows_space else {"section_out_of_plane": _UNKNOWN}
    return {"blade_length": blade.length, "blade": json.dumps(describe(blade)), **remark}


def loads_of(attrs: Attributes) -> tuple[Load, ...]:
    """Return the loads that the attributes of a run describe."""
    return tuple(from_description(one, Load) for one in json.loads(attrs.get("loads", "[]")))


def loads_attributes(loads: Sequence[Load]) -> dict[str, object]:
    """Return the attribute by which a run says its loads, none without; `loads_of` reads it."""
    return {"loads": json.dumps(list(map(describe, loads)))} if loads else {}


def start_attributes(start: object) -> dict[str, object]:
    """Return the attribute by which a motion says its start: "steady", or "given"; else none."""
    return {} if start == "straight" else {"start": start if start == "steady" else "given"}


def theory_attributes(theory: Theory) -> dict[str, object]:
    """Return the attributes by which an answer says where its theory is not Bernoulli and Euler's.

    Numbers, for files hold no booleans: a shear of 1 is that of the stations.
    """
    values = asdict(theory).items()
    return {
        name: value if isinstance(value, float | str) else int(value)
        for name, value in values
        if value != getattr(BERNOULLI_EULER, name)
    }


def theory_of(attrs: Attributes) -> Theory:
    """Return the theory that the attributes of an answer describe."""
    stored = {k.name: attrs[k.name] for k in fields(Theory) if k.name in attrs}
    # A number among them is the ratio of shear, a text a kind of trapeze effect.
    values: dict[str, Any] = {
        k: v if isinstance(v, float | str) else bool(v) for k, v in stored.items()
    }
    return Theory(**values)


def motion_of(attrs: Attributes) -> Motion:
    """Return the rotation of the clamp that the attributes of a run describe."""
    if "motion" in attrs:
        return from_description(json.loads(attrs["motion"]), Motion)
    omega, ramp_time = float(attrs["omega"]), float(attrs["ramp_time"])
    return SpinUp(omega=omega, ramp_time=ramp_time) if ramp_time else SteadyRotation(omega=omega)


def motion_attributes(motion: Motion) -> dict[str, object]:
    """Return the attribute by which a run says how it was driven; `motion_of` reads it.

    Eq. 1 and a steady rotation need none besides omega and ramp_time. A rotation that is no known
    kind is refused.
    """
    if type(motion) in (SpinUp, SteadyRotation):
        return {}
    return {"motion": json.dumps(describe(motion))}


def versions() -> dict[str, str]:
    """Return the versions that a result depends on, of the libraries that are installed."""
    numbers = {"rotbeam-exu": __version__, "python": platform.python_version()}
    for name in ("exudyn", "numpy", "scipy"):
        try:
            numbers[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return numbers
