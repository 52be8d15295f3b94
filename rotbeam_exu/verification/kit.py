"""The kit: all that an author of a code needs to take part, in any language, as plain files.

Its problem statement, PROBLEM.pdf, is typeset by `make references`, from tools/problem.typ.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from analytic import Blade, Damping, Gravity, PointMass, Section, SpinUp, SteadyRotation
from analytic.arrays import FloatArray, stations
from analytic.exact.continuum.unit import space_unit
from analytic.input_checks import finite_array
from analytic.motion import Motion

from ..files.results import whole_file
from .case import Asked, Case
from .cases import CASES, VERSION, blade_of_table
from .judgement import THRESHOLDS
from .references import reference
from .submission_files.runs import FARTHEST
from .submission_files.tables import DIGITS

STATIC = Path(__file__).parent / "data" / "kit"
"""Files that every kit has as they stand: the problem, starters, a sample submission."""

MESHES = (8, 16, 32, 64, 128)
"""Numbers of elements at whose nodes an orbit is written; codes of order two need the last ones."""

SPACING = 0.01
"""Time between the samples of drives and of the history for self-check [s]."""


def write_kit(folder: str | os.PathLike[str]) -> Path:
    """Write the kit, each file whole or not at all, and return the folder.

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
    contents = kit_files()
    for name, content in contents.items():
        path = target / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(path) as partial:
            partial.write_bytes(content)
    return target


def kit_files() -> dict[str, bytes]:
    """Return the contents of all files by their names below the folder."""
    files = {
        path.relative_to(STATIC).as_posix(): path.read_bytes()
        for path in sorted(STATIC.rglob("*"))
        if path.is_file() and path.suffix != ".pyc"
    }
    histories = [case for case in CASES.values() if case.asked is Asked.HISTORY]
    texts = {"VERSION": f"{VERSION}\n", "cases.csv": cases_csv(), "cases.json": _cases_json()}
    texts |= {f"drive_{case.name}.csv": _drive(case) for case in histories}
    texts |= {
        f"start_{case.name}_{elements}.csv": start_table(
            case, np.linspace(0.0, case.blade.length, elements + 1)
        )
        for case in histories
        if case.amplitudes
        for elements in MESHES
    }
    tables = {case.table: case.blade for case in CASES.values() if case.table}
    texts |= {f"blades/{table}_line.csv": _line(blade) for table, blade in tables.items()}
    texts["reference_S1.csv"] = _self_check(CASES["S1"])
    files |= {name: text.encode() for name, text in texts.items()}
    sums = [f"{hashlib.sha256(files[name]).hexdigest()}  {name}\n" for name in sorted(files)]
    return files | {"SHA256SUMS": "".join(sums).encode()}


def _cases_json() -> str:
    document = {
        "benchmark": VERSION,
        "units": UNITS,
        "cases": [row_of(case) | {"title": case.title} for case in CASES.values()],
        "thresholds": THRESHOLDS,
        "samples": {"largest distance [s]": FARTHEST, "significant digits": DIGITS},
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _drive(case: Case) -> str:
    """Return angle, rate and acceleration of the clamp."""
    time, motion = _times(case), case.rotation
    columns = {
        "t": time,
        "theta": motion.angle(time),
        "theta_dot": motion.rate(time),
        "theta_ddot": motion.acceleration(time),
    }
    said = f"case {case.name}: motion of the clamp, Eq. 1 of PROBLEM.pdf; s, rad, rad/s, rad/s^2"
    return _table(said, columns)


def start_table(case: Case, places: ArrayLike) -> str:
    """Return the orbit that a case starts on, at phase 0, as a table in SI units and radians.

    Its rows are at places (rows,) along the undeformed beam [m], seen from the turning frame;
    ValueError for places beyond the beam, and for cases that start at rest.
    """
    orbit, x = case.orbit, finite_array("places", places)
    state = orbit.state(0, x)
    slope, slope_dot = ((of[:, :2] @ [1.0, 1.0j]) for of in (state.slope, state.slope_rate))
    (X, Y), (X_dot, Y_dot) = state.place.T[:2], state.velocity.T[:2]
    positions = {"x": x, "X": X, "Y": Y, "angle": np.angle(slope)}
    rates = {"X_dot": X_dot, "Y_dot": Y_dot, "angle_dot": (slope_dot / slope).imag}
    slopes = {"X_slope": slope.real, "Y_slope": slope.imag}
    slope_rates = {"X_slope_dot": slope_dot.real, "Y_slope_dot": slope_dot.imag}
    said = (
        f"case {case.name}: {x.size} places at t = 0, in the frame that turns with the clamp, as "
        f"are all rates; m, rad, m/s, rad/s; slopes are derivatives to x"
    )
    return _table(said, positions | slopes | rates | slope_rates)


def _line(blade: Blade) -> str:
    """Return places and sections of an unloaded blade, at its stations and three points between."""
    at = np.array(stations(blade.line.twist))
    x = np.interp(np.arange(4 * at.size - 3) / 4.0, np.arange(at.size), at)
    place, sections = space_unit(blade).unloaded(x / blade.length)
    columns = {"x": x} | dict(zip("XYZ", blade.length * place.T, strict=True))
    for axis, of in enumerate(np.moveaxis(sections, -1, 0), 1):
        columns |= {f"{name}{axis}": value for name, value in zip("XYZ", of.T, strict=True)}
    said = "the unloaded blade in the clamp's frame: m, and axes 1, 2, 3 of its sections"
    return _table(said, columns)


def _self_check(case: Case) -> str:
    time, truth = _times(case), reference(case)
    said = f"case {case.name}: the reference, within {truth.bound:.0e} of max|q|; s, m, m/s"
    return _table(said, {"time": time, "q": truth.history(time), "q_dot": truth.history(time, 1)})


def _times(case: Case) -> FloatArray:
    return np.linspace(0.0, case.duration, round(case.duration / SPACING) + 1)


def _table(said: str, columns: dict[str, FloatArray]) -> str:
    """Return comma-separated values with 17 digits."""
    rows: Sequence[Sequence[float]] = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(f"{value:.17g}" for value in row) for row in rows]
    return "\n".join([f"# {said}", ",".join(columns), *lines, ""])


UNITS = {
    "L": "m", "EA": "N", "EI": "N m^2", "rhoA": "kg/m", "EI_flap/EI": "1", "GJ/EI": "1",
    "twist": "rad", "precone": "rad", "hub_radius": "m", "tip_mass": "kg", "bending_damping": "s",
    "gravity": "m/s^2", "gravity_tilt": "rad", "kick": "m/s", "omega": "rad/s", "T": "s",
    "duration": "s", "speeds": "rad/s", "amplitudes": "1",
}  # fmt: skip
"""Units of the numbers in cases.csv, by the names of the columns."""


def row_of(case: Case) -> dict[str, Any]:
    """Return the data of a case by the names in cases.csv; None stands for missing data.

    ValueError of a case that is more than they say.
    """
    blade, motion = case.blade, case.motion
    section, out_of_plane = blade.section, blade.section.out_of_plane
    table = case.table
    gravity = next((one for one in case.loads if isinstance(one, Gravity)), Gravity(0.0))
    row = {
        "id": case.name,
        "level": str(case.level),
        "asked": case.asked.name.lower(),
        "stations": f"blades/{table}.csv" if table else None,
        "L": blade.length,
        "EA": None if table else section.axial_stiffness,
        "EI": None if table else section.bending_stiffness,
        "rhoA": None if table else section.mass_per_length,
        "EI_flap/EI": out_of_plane.bending_ratio if out_of_plane else None,
        "GJ/EI": out_of_plane.torsion_ratio if out_of_plane else None,
        # It grows from 0 at the clamp.
        "twist": None if table else float(np.max(blade.line.twist)),
        "precone": blade.line.precone,
        "hub_radius": blade.hub_radius,
        "tip_mass": blade.point_masses[0].mass if blade.point_masses else 0.0,
        "bending_damping": blade.damping.bending,
        "gravity": gravity.gravity,
        "gravity_tilt": gravity.tilt,
        "kick": case.kick,
        "start": "equilibrium" if case.settled else None,
        "omega": motion.omega if motion else None,
        "T": case.ramp_time or None if motion else None,
        "duration": case.duration or None,
        "speeds": list(case.speeds),
        "count": case.count if case.asked is Asked.FREQUENCIES else None,
        "amplitudes": list(case.amplitudes),
    }
    for name, read in _read_back(row).items():
        has = getattr(blade if hasattr(blade, name) else case, name)
        if has != read:
            raise ValueError(
                f"case {case.name} has {name} = {has!r}, of which cases.csv would have {read!r}: "
                "name what is missing in row_of, _read_back and UNITS"
            )
    return row


def _read_back(row: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of the blade, motion and loads as a reader of a row takes them."""
    mass, gravity = row["tip_mass"], Gravity(row["gravity"], tilt=row["gravity_tilt"])
    if row["stations"]:
        blade = blade_of_table(Path(row["stations"]).stem).with_hub_radius(row["hub_radius"])
    else:
        # A cell holds a number: what changes along the blade is not told.
        EA, EI, rhoA = (float(np.ravel(row[name])[0]) for name in ("EA", "EI", "rhoA"))
        section = Section(axial_stiffness=EA, bending_stiffness=EI, mass_per_length=rhoA)
        blade = Blade(
            length=row["L"], section=section, hub_radius=row["hub_radius"],
            point_masses=(PointMass(position=row["L"], mass=mass),) if mass else (),
            damping=Damping(bending=row["bending_damping"]),
        )  # fmt: skip
    if row["EI_flap/EI"] is not None:
        blade = blade.with_section_out_of_plane(row["EI_flap/EI"], row["GJ/EI"])
    if row["twist"]:
        blade = blade.with_twist(row["twist"])
    if row["precone"]:
        blade = blade.with_precone(row["precone"])
    motion: Motion | None = None
    if row["omega"] is not None:
        motion = SteadyRotation(omega=row["omega"])
        if row["T"] is not None:
            motion = SpinUp(omega=row["omega"], ramp_time=row["T"])
    loads = (gravity,) if gravity.gravity else ()
    return {one.name: getattr(blade, one.name) for one in fields(blade)} | {
        "motion": motion, "loads": loads, "settled": row["start"] == "equilibrium"
    }  # fmt: skip


def cases_csv() -> str:
    """Return the rows of all cases as comma-separated values."""
    rows = [row_of(case) for case in CASES.values()]
    lines = [",".join(rows[0]), *(",".join(map(_cell, row.values())) for row in rows)]
    return "\n".join([*lines, ""])


def _cell(value: object) -> str:
    if value is None:
        return ""
    return " ".join(map(repr, value)) if isinstance(value, list) else str(value)
