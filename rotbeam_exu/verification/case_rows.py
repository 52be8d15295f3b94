"""Numbers of the cases as rows: cases.csv, cases.json and the problem's table have them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, is_dataclass
from typing import Any

from .cases import CASES, Asked, Case, stated


@dataclass(frozen=True)
class CaseColumn:
    """A column of cases.csv: its name, its unit, and the cell of a case that has none.

    PROBLEM.pdf tells it below "besides", where it has such words; {} is the number.
    """

    name: str
    unit: str
    nothing: float | None = None
    besides: str = ""


_TIP_MASS = CaseColumn("tip_mass", "kg", 0.0, "mass at the tip {} kg")
_ETA = "moment $E I (phi' + eta dot(phi)')$,\\ $eta = {}$ s"
_LEVEL = "along $-bold(b)_3$"
_OMEGA = CaseColumn("omega", "rad/s")
_PITCH = "twist $theta = {}$"
COLUMNS = {
    "length": CaseColumn("L", "m"),
    "section.axial_stiffness": CaseColumn("EA", "N"),
    "section.bending_stiffness": CaseColumn("EI", "N m^2"),
    "section.mass_per_length": CaseColumn("rhoA", "kg/m"),
    "section.out_of_plane.bending_ratio": CaseColumn("EI_flap/EI", "1"),
    "section.out_of_plane.torsion_ratio": CaseColumn("GJ/EI", "1"),
    "line.twist.in proportion": CaseColumn("twist", "rad", 0.0, _PITCH),
    "line.precone": CaseColumn("precone", "rad", 0.0, "precone $beta = {}$"),
    "hub_radius": CaseColumn("hub_radius", "m", 0.0),
    "point_masses.PointMass.mass": _TIP_MASS,
    "point_masses.PointMass.position": CaseColumn("L", "m"),
    "damping.bending": CaseColumn("bending_damping", "s", 0.0, _ETA),
    "loads.Gravity.gravity": CaseColumn("gravity", "m/s^2", 0.0, "gravity $g = {}$ m/s²"),
    "loads.Gravity.tilt": CaseColumn("gravity_tilt", "rad", 0.0, _LEVEL),
    "kick": CaseColumn("kick", "m/s", 0.0, "kick $v = {}$ m/s"),
    "motion.SpinUp.omega": _OMEGA,
    "motion.SteadyRotation.omega": _OMEGA,
    "motion.SpinUp.ramp_time": CaseColumn("T", "s"),
}
"""Columns by the part of blade, motion or loads that they tell; a part without one is refused."""


def row_of(case: Case) -> dict[str, Any]:
    """Return the data of a case by the names in cases.csv; None stands for missing data.

    Raises
    ------
    ValueError
        If the case has what no column says.
    """
    told, lost = dict[str, float](), []
    for part, value in sorted(_parts_of(case)):
        name = COLUMNS[part].name if part in COLUMNS else ""
        if not (name and isinstance(value, float)) or told.setdefault(name, value) != value:
            lost.append(part)
    if lost:
        raise ValueError(
            f"cases.csv has no column for {', '.join(lost)} of case {case.name}: add it to "
            "COLUMNS, or leave it out of the case"
        )
    return {
        "id": case.name,
        "level": str(case.level),
        "asked": case.asked.name.lower(),
        **{one.name: told.get(one.name, one.nothing) for one in COLUMNS.values()},
        "duration": case.duration or None,
        "speeds": list(case.speeds),
        "count": case.count if case.asked is Asked.FREQUENCIES else None,
        "amplitudes": list(case.amplitudes),
    }


def _parts_of(case: Case) -> Iterator[tuple[str, Any]]:
    """Yield what blade, motion and loads state, by the names of where it stands."""
    yield from _parts("", case.blade.blade)
    yield from _parts("motion.", (case.motion,) if case.motion else ())
    yield from _parts("loads.", case.loads)
    yield from _parts("kick", case.kick) if case.kick else ()


def _parts(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, tuple) and len(value) == 1:
        (value,) = value
        path += f"{type(value).__name__}."
    elif isinstance(value, tuple) and len(value) == 2 and value[0] == 0.0:
        value, path = value[1], f"{path}in proportion."  # a profile that grows with x
    if is_dataclass(value):
        for name, part in stated(value).items():
            yield from _parts(f"{path}{name}.", part)
    elif value != ():
        yield path.rstrip("."), value


def cases_csv() -> str:
    """Return the rows of all cases as comma-separated values."""
    rows = [row_of(case) for case in CASES.values()]
    lines = [",".join(rows[0]), *(",".join(map(_cell, row.values())) for row in rows)]
    return "\n".join([*lines, ""])


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return " ".join(map(repr, value)) if isinstance(value, list) else str(value)
