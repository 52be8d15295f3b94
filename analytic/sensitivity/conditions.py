"""The numbers of a motion and of its loads, under which a blade answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

from ..blade import Blade
from ..load import Load
from ..motion import Motion
from .parameters import Parameter, factor_of


def conditions_of(motion: Motion, loads: Sequence[Load], unit: float) -> dict[str, Parameter]:
    """Return the numbers of a motion and of the loads by name, of a blade with a unit [rad/s].

    "omega", and "start" and "ramp_time" where they are fields; each load is a factor, "loads[0]".
    """
    found = []
    for one in fields(motion):  # type: ignore[arg-type]
        if one.name in ("start", "omega", "ramp_time"):
            value = getattr(motion, one.name)
            size, of = (value, "s") if one.name == "ramp_time" else (value or unit, "rad/s")
            changed = partial(_otherwise, motion, loads, one.name)
            found.append(Parameter(one.name, value, of, size, changed, least=0.0))
    for k in range(len(loads)):
        found.append(factor_of(f"loads[{k}]", partial(_other_load, motion, loads, k)))
    return {one.name: one for one in found}


def _otherwise(
    motion: Any, loads: Sequence[Load], name: str, value: float
) -> tuple[Motion, Sequence[Load]]:
    return replace(motion, **{name: value}), loads


def _other_load(
    motion: Motion, loads: Sequence[Load], k: int, factor: float
) -> tuple[Motion, Sequence[Load]]:
    return motion, tuple(load.times(factor) if n == k else load for n, load in enumerate(loads))


def case_of(
    other: Any, blade: Blade, given: tuple[Any, Sequence[Load]]
) -> tuple[Blade, Any, Sequence[Load]]:
    """Return blade, motion and loads, of which `other` is another blade, or a motion and loads."""
    return (other, *given) if isinstance(other, Blade) else (blade, *other)
