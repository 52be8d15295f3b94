"""Measured numbers of a blade from a CSV: frequencies, numbers of steady states or motions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from analytic import PointLoad, SpinUp
from analytic.sensitivity import Measured, MeasuredFrequency, MeasuredMotion, MeasuredState
from analytic.sensitivity.measured import OUTPUTS

from .stations_file import columns_of

_FORCES, _MOTION = ("fx", "fy", "fz"), ("time", "ramp_time")
_STATES = {output.replace(" ", "_"): unit for output, unit in OUTPUTS.items()}
_EXAMPLE = "mode,omega [rpm],frequency [Hz],deviation [%]"


def measured_of(path: Path) -> list[Measured]:
    """Return what a CSV file has as measured: of one kind, a row each.

    Natural frequencies have the columns `mode`, `frequency` and, if known, `omega` and `deviation`.
    Numbers of steady states have one column of `deflection_x`, `deflection_y`, `deflection_z`,
    `tip_x`, `twist`, `root_force_x` and so on, and a force `fx`, `fy`, `fz` at the tip, or at a
    place `x`. With the columns `time`, `omega`, `ramp_time` and `deviation` they are of a spin-up
    by Eq. 1. Each has its unit behind it, as `frequency [Hz]`; `deviation [%]` is of the value, of
    a spin-up of the largest one.

    Raises
    ------
    ValueError
        If a column is missing or unknown, or its unit, or a cell is no number.
    """
    units = {"mode": "", "frequency": "rad/s", **_STATES, "omega": "rad/s", "deviation": "1"}
    units |= {"x": "m"} | dict.fromkeys(_FORCES, "N") | dict.fromkeys(_MOTION, "s")
    columns = columns_of(path, units, _EXAMPLE)
    kinds = ("frequency", *_STATES)
    measured = [name for name in kinds if name in columns]
    if len(measured) != 1:
        raise ValueError(
            f"{path} has {len(measured)} columns of what was measured: give one of "
            f"{', '.join(kinds)}, and other kinds in files of their own"
        )
    (kind,) = measured
    if kind == "frequency" and "mode" not in columns:
        raise ValueError(f"{path} lacks the column mode, as lag 1 or its number")
    of_kind: tuple[str, ...] = ("mode",) if kind == "frequency" else ("x", *_FORCES)
    if moves := kind in _STATES and bool({*_MOTION} & columns.keys()):
        of_kind = _MOTION
        if missing := [n for n in ("omega", *_MOTION, "deviation") if n not in columns]:
            raise ValueError(f"{path} lacks {', '.join(missing)}, which a spin-up needs as well")
        columns["deviation"] = columns["deviation"] * np.abs(columns[kind]).max()
    belong = {kind, "omega", "deviation", *of_kind}
    if astray := sorted(columns.keys() - belong):
        raise ValueError(f"{path} has {', '.join(astray)}, which {kind} does not use: take it out")
    return [
        (_moving if moves else _row)({name: of[k].item() for name, of in columns.items()}, kind)
        for k in range(columns[kind].size)
    ]


def _moving(cells: dict[str, Any], kind: str) -> Measured:
    return MeasuredMotion(
        output=kind.replace("_", " "),
        value=cells[kind],
        deviation=cells["deviation"],
        time=cells["time"],
        spin_up=SpinUp(omega=cells["omega"], ramp_time=cells["ramp_time"]),
    )


def _row(cells: dict[str, Any], kind: str) -> Measured:
    value, share = cells[kind], cells.get("deviation")
    numbers: dict[str, Any] = {
        "value": value,
        "omega": cells.get("omega", 0.0),
        "deviation": None if share is None else share * abs(value),
    }
    if kind == "frequency":
        mode = cells["mode"]
        return MeasuredFrequency(mode=int(mode) if mode.isdecimal() else mode, **numbers)
    force = tuple(cells.get(name, 0.0) for name in _FORCES)
    loads = [PointLoad(force=force, position=cells.get("x"))] if any(force) else []
    return MeasuredState(output=kind.replace("_", " "), loads=loads, **numbers)
