"""The kit: all that an author of a code needs to take part, in any language, as plain files."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from analytic import Blade, Damping, Gravity, PointMass, Section, SpinUp, SteadyRotation
from analytic.arrays import FloatArray
from analytic.description import describe

from .cases import CASES, VERSION, Asked, Case, starting_orbit
from .judgement import THRESHOLDS
from .references import reference
from .submission_files.histories import FARTHEST
from .submission_files.tables import DIGITS

STATIC = Path(__file__).parent / "data" / "kit"
"""What is in every kit as it stands: the problem, starters, a sample submission."""

MESHES = (8, 16, 32, 64, 128)
"""Numbers of elements at whose nodes an orbit is written; those of order two need the last ones."""

_SOURCES = {"problem.typ", "PROBLEM.sha256"}  # of the PDF, which is what an author wants

SPACING = 0.01
"""Of drives and of the history for self-check [s]."""


def write_kit(folder: str | os.PathLike[str]) -> Path:
    """Write the kit, whole or not at all, and return the folder.

    Parameters
    ----------
    folder : path
        New, or empty.

    Raises
    ------
    FileExistsError
        If something is in the folder, or it is a file.
    OSError
        If it cannot be written.
    """
    target = Path(folder)
    if target.exists() and not (target.is_dir() and not any(target.iterdir())):
        what = "is not empty" if target.is_dir() else "is a file"
        raise FileExistsError(f"{target} {what}: name a folder that is new, or empty")
    contents, made = kit_files(), None
    try:
        target.absolute().parent.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(prefix=".kit-", dir=target.absolute().parent))
        for name, content in contents.items():
            path = made / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        made.chmod(0o755)
        if target.exists():
            target.rmdir()
        made.rename(target)
    except OSError as error:
        raise OSError(
            f"cannot write to {target.parent}: {error.strerror or error}; choose another folder"
        ) from error
    finally:
        if made is not None:
            shutil.rmtree(made, ignore_errors=True)
    return target


def kit_files() -> dict[str, bytes]:
    """Return the contents of all files by their names below the folder."""
    files = {
        path.relative_to(STATIC).as_posix(): path.read_bytes()
        for path in sorted(STATIC.rglob("*"))
        if path.is_file() and path.suffix != ".pyc" and path.name not in _SOURCES
    }
    histories = [case for case in CASES.values() if case.asked is Asked.HISTORY]
    texts = {"VERSION": f"{VERSION}\n", "cases.csv": _cases_csv(), "cases.json": _cases_json()}
    texts |= {f"drive_{case.name}.csv": _drive(case) for case in histories}
    texts |= {
        f"start_{case.name}_{elements}.csv": _start(case, elements)
        for case in histories
        if case.amplitudes
        for elements in MESHES
    }
    texts["reference_S1.csv"] = _self_check(CASES["S1"])
    files |= {name: text.encode() for name, text in texts.items()}
    sums = [f"{hashlib.sha256(files[name]).hexdigest()}  {name}\n" for name in sorted(files)]
    return files | {"SHA256SUMS": "".join(sums).encode()}


def row_of(case: Case) -> dict[str, Any]:
    """Return the data of a case by the names in cases.csv; what it does not have is None.

    Raises
    ------
    ValueError
        If the case has what these names cannot say.
    """
    blade = case.blade.blade
    ramp = case.motion.ramp_time if isinstance(case.motion, SpinUp) else None
    row = {
        "id": case.name,
        "level": str(case.level),
        "asked": case.asked.name.lower(),
        "L": blade.length,
        "EA": blade.axial_stiffness,
        "EI": blade.bending_stiffness,
        "rhoA": blade.mass_per_length,
        "hub_radius": blade.hub_radius,
        "tip_mass": float(sum(mass.mass for mass in blade.point_masses)),
        "bending_damping": blade.damping.bending,
        "gravity": sum(load.gravity for load in case.loads if isinstance(load, Gravity)),
        "omega": None if case.motion is None else case.motion.omega,
        "T": ramp,
        "duration": case.duration or None,
        "speeds": list(case.speeds),
        "amplitudes": list(case.amplitudes),
    }
    asked, said = _parts(blade, case.motion, case.loads), _parts(*_said(row))
    lost = [name for name in sorted(asked | said) if asked.get(name) != said.get(name)]
    if lost:
        raise ValueError(
            f"cases.csv has no column for {', '.join(lost)} of case {case.name}: add it to "
            "row_of and to the problem, or leave it out of the case"
        )
    return row


def _said(row: dict[str, Any]) -> tuple[Blade, SpinUp | SteadyRotation | None, tuple[Gravity, ...]]:
    """Return what an author makes of a row."""
    section = Section(
        axial_stiffness=row["EA"], bending_stiffness=row["EI"], mass_per_length=row["rhoA"]
    )
    tip, omega, ramp = row["tip_mass"], row["omega"], row["T"]
    blade = Blade(
        length=row["L"],
        section=section,
        hub_radius=row["hub_radius"],
        point_masses=(PointMass(position=row["L"], mass=tip),) if tip else (),
        damping=Damping(bending=row["bending_damping"]),
    )
    steady = None if omega is None else SteadyRotation(omega=omega)
    motion = SpinUp(omega=omega, ramp_time=ramp) if ramp else steady
    return blade, motion, (Gravity(row["gravity"]),) if row["gravity"] else ()


def _parts(blade: Blade, motion: Any, loads: Sequence[Any]) -> dict[str, Any]:
    """Return all numbers by the names of where they stand, to be compared."""
    told = describe(blade)
    section, damping = told.pop("section"), told.pop("damping")
    return {
        **told,
        **{f"section.{name}": value for name, value in section.items()},
        **{f"damping.{name}": value for name, value in damping.items()},
        "motion": motion,
        "loads": tuple(loads),
    }


_UNITS = {
    "L": "m", "EA": "N", "EI": "N m^2", "rhoA": "kg/m", "hub_radius": "m", "tip_mass": "kg",
    "bending_damping": "s", "gravity": "m/s^2", "omega": "rad/s", "T": "s", "duration": "s",
    "speeds": "rad/s", "amplitudes": "1",
}  # fmt: skip


def _cases_csv() -> str:
    rows = [row_of(case) for case in CASES.values()]
    lines = [",".join(rows[0]), *(",".join(map(_cell, row.values())) for row in rows)]
    return "\n".join([*lines, ""])


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return " ".join(map(repr, value)) if isinstance(value, list) else str(value)


def _cases_json() -> str:
    document = {
        "benchmark": VERSION,
        "units": _UNITS,
        "cases": [row_of(case) | {"title": case.title} for case in CASES.values()],
        "thresholds": THRESHOLDS,
        "samples": {"largest distance [s]": FARTHEST, "least significant digits": DIGITS},
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _drive(case: Case) -> str:
    """Return angle, rate and acceleration of the clamp."""
    assert case.motion is not None
    time = _times(case)
    motion = case.motion
    columns = {
        "t": time,
        "theta": motion.angle(time),
        "theta_dot": motion.rate(time),
        "theta_ddot": motion.acceleration(time),
    }
    said = f"case {case.name}: motion of the clamp, Eq. 1 of PROBLEM.pdf; s, rad, rad/s, rad/s^2"
    return _table(said, columns)


def _start(case: Case, elements: int) -> str:
    """Return an exact orbit at the nodes of a mesh, at phase 0."""
    orbit, x = starting_orbit(case), np.linspace(0.0, case.blade.length, elements + 1)
    state = orbit.state(0, x)
    slope = 1.0 + state.u_slope + 1j * state.v_slope
    slope_dot = state.u_slope_dot + 1j * state.v_slope_dot
    positions = {"x": x, "X": x + state.u, "Y": state.v, "angle": np.angle(slope)}
    rates = {
        "X_dot": state.u_dot,
        "Y_dot": state.v_dot,
        "angle_dot": (slope_dot / slope).imag,
    }
    slopes = {"X_slope": slope.real, "Y_slope": slope.imag}
    slope_rates = {"X_slope_dot": slope_dot.real, "Y_slope_dot": slope_dot.imag}
    said = (
        f"case {case.name}: the nodes of {elements} elements at t = 0, in the frame that turns "
        f"with the clamp; m, rad, m/s, rad/s; slopes are derivatives to x"
    )
    return _table(said, positions | slopes | rates | slope_rates)


def _self_check(case: Case) -> str:
    time, truth = _times(case), reference(case)
    said = f"case {case.name}: the reference, within {truth.bound:.0e} of max|q|; s, m, m/s"
    return _table(said, {"time": time, "q": truth.history(time), "q_dot": truth.rate(time)})


def _times(case: Case) -> FloatArray:
    return np.linspace(0.0, case.duration, round(case.duration / SPACING) + 1)


def _table(said: str, columns: dict[str, FloatArray]) -> str:
    """Return comma-separated values with 17 digits."""
    rows: Sequence[Sequence[float]] = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(f"{value:.17g}" for value in row) for row in rows]
    return "\n".join([f"# {said}", ",".join(columns), *lines, ""])
