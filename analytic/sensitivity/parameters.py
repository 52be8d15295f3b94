"""The numbers of a blade by name, each with the blade that has another value of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import FloatArray, in_units
from ..blade import Blade
from ..section import Section
from ..station_section import MASSES, STIFFNESSES, about_centers, nested
from ..theory import Theory

_FORCE, _AREA = "N", "N m^2"
_UNITS = {"EA": _FORCE, "GA2": _FORCE, "GA3": _FORCE, "GJ": _AREA, "EI2": _AREA, "EI3": _AREA}
_UNITS |= {"m": "kg/m", "j1": "kg m", "j2": "kg m", "j3": "kg m"}
_SMALL = 0.01  # of the length: the size of offsets
_TURN = 0.1  # [rad], the size of angles


@dataclass(frozen=True)
class Parameter:
    """A number of a blade.

    Parameters
    ----------
    name : str
        As "EI3" for all the blade or "EI3[4]" at station 4, counted from 0.
    value : float
        Now; a factor, 1, for all the blade.
    unit : str
    size : float
        By which a change is small or large.
    changed : callable
        From another value to the blade that has it.
    moves : bool
        Whether it moves the unloaded blade, or its clamp.
    """

    name: str
    value: float
    unit: str
    size: float
    changed: Callable[[float], Blade]
    moves: bool = False


def parameters_of(blade: Blade, theory: Theory) -> dict[str, Parameter]:
    """Return the parameters of a blade by name, those of its stations last.

    EA, EI3 (in the plane of bending at the setting angle zero), EI2, GJ, m and j, the rotary
    inertia, are factors for all the blade; `hub_radius`, `setting_angle` and `precone`;
    `point_mass[k]`. Of a table at each station all stiffnesses and masses about their centers, the
    twist, and (c2, c3) of the centers of tension and mass as `tension2[k]` and so on.

    Examples
    --------
    >>> from analytic import Beam, Theory
    >>> from analytic.sensitivity import parameters_of
    >>> print(*parameters_of(Beam.reference().with_tip_mass(0.1), Theory()))
    EA EI3 m hub_radius setting_angle precone point_mass[0]
    """
    found = [*(_of_table if blade.table else _of_section)(blade, theory)]
    return {one.name: one for one in found}


def _of_section(blade: Blade, theory: Theory) -> Iterator[Parameter]:
    del theory  # its shear stiffness goes with EA
    section, out = blade.section, blade.section.out_of_plane
    profiles = {"EA": "axial_stiffness", "EI3": "bending_stiffness", "m": "mass_per_length"}
    if section.rotary_inertia is not None:
        profiles["j"] = "rotary_inertia"
    for name, key in profiles.items():
        yield _factor(name, partial(_scaled, blade, key))
    if out is not None:
        for name, key in (("EI2", "bending_ratio"), ("GJ", "torsion_ratio")):
            if np.isfinite(getattr(out, key) or np.inf):
                yield _factor(name, partial(_other_ratio, blade, key))
    yield from _of_line(blade)


def _factor(name: str, changed: Callable[[float], Blade]) -> Parameter:
    return Parameter(name, 1.0, "1", 1.0, changed)


def _scaled(blade: Blade, key: str, factor: float) -> Blade:
    section: Section = replace(
        blade.section, **{key: in_units(getattr(blade.section, key), 1.0, 1.0 / factor)}
    )
    if key == "bending_stiffness" and (out := section.out_of_plane) is not None:
        # The same stiffness out of the plane, over another one in it.
        torsion = None if out.torsion_ratio is None else out.torsion_ratio / factor
        out = replace(out, bending_ratio=out.bending_ratio / factor, torsion_ratio=torsion)
        section = replace(section, out_of_plane=out)
    return blade.with_section(section)


def _other_ratio(blade: Blade, key: str, factor: float) -> Blade:
    out = blade.section.out_of_plane
    out = replace(out, **{key: factor * getattr(out, key)})
    return blade.with_section(replace(blade.section, out_of_plane=out))


def _of_line(blade: Blade) -> Iterator[Parameter]:
    """Yield what the blade has besides its sections."""
    radius, angle, cone = blade.hub_radius, blade.setting_angle, blade.line.precone
    yield Parameter("hub_radius", radius, "m", blade.length, blade.with_hub_radius, moves=True)
    yield Parameter("setting_angle", angle, "rad", _TURN, blade.with_setting_angle, moves=True)
    yield Parameter("precone", cone, "rad", _TURN, blade.with_precone, moves=True)
    for k, one in enumerate(blade.point_masses):
        yield Parameter(
            f"point_mass[{k}]", one.mass, "kg", one.mass, partial(_other_mass, blade, k)
        )


def _other_mass(blade: Blade, k: int, mass: float) -> Blade:
    masses = list(blade.point_masses)
    masses[k] = replace(masses[k], mass=mass)
    return replace(blade, point_masses=tuple(masses))


def _of_table(blade: Blade, theory: Theory) -> Iterator[Parameter]:
    table = blade.table
    assert table is not None
    every, count = slice(None), len(table.x)
    sheared = theory.shear is not None
    stiffnesses = [n for n in STIFFNESSES if sheared or not n.startswith("GA")]
    for name in stiffnesses:
        yield _factor(name, partial(_entry, blade, 0, name, every, None))
    yield _factor("m", partial(_entry, blade, 1, "m", every, None))
    yield from _of_line(blade)
    S, M = (about_centers(np.array(kind)) for kind in (table.stiffness, table.mass))
    for name in stiffnesses:
        values = S[1][:, *2 * [STIFFNESSES.index(name)]]
        yield from _at_stations(blade, 0, name, values)
    for name in MASSES:
        values = M[1][:, *2 * [(0, 3, 4, 5)[MASSES.index(name)]]]
        yield from _at_stations(blade, 1, name, values)
    for which, name, onto in ((0, "tension", S[0]), (1, "center", M[0])):
        for axis, sign, column in ((2, -1.0, 5), (3, 1.0, 4)):
            for k in range(count):
                yield Parameter(
                    f"{name}{axis}[{k}]", sign * float(onto[k, 0, column]), "m",
                    _SMALL * blade.length, partial(_center, blade, which, axis, k),
                )  # fmt: skip
    twist = np.array(blade.line.twist if isinstance(blade.line.twist, tuple) else [])
    if twist.shape == (count, 2):
        for k in range(count):
            yield Parameter(
                f"twist[{k}]", float(twist[k, 1]), "rad", _TURN, partial(_twisted, blade, k),
                moves=True,
            )  # fmt: skip


def _at_stations(blade: Blade, which: int, name: str, values: FloatArray) -> Iterator[Parameter]:
    for k, value in enumerate(values.tolist()):
        if value > 0.0:
            changed = partial(_entry, blade, which, name, k, value)
            yield Parameter(f"{name}[{k}]", value, _UNITS[name], value, changed)


def _entry(
    blade: Blade, which: int, name: str, at: int | slice, now: float | None, value: float
) -> Blade:
    """Return the blade with another entry of its matrices about their centers, or a multiple."""
    factor = value if now is None else value / now
    if which == 0:
        places = [STIFFNESSES.index(name)]
    else:
        # The mass is there for each direction; inertias about the center stay.
        places = [0, 1, 2] if name == "m" else [2 + MASSES.index(name)]

    def edit(onto: FloatArray, about: FloatArray) -> None:
        del onto
        scale = np.ones(6)
        scale[places] = factor
        diagonal = about[at] * np.eye(6)
        about[at] += diagonal * (scale - 1.0)

    return _edited(blade, which, edit)


def _center(blade: Blade, which: int, axis: int, k: int, place: float) -> Blade:
    def edit(onto: FloatArray, about: FloatArray) -> None:
        del about
        onto[k, 0, 5 if axis == 2 else 4] = -place if axis == 2 else place
        if which == 1:
            onto[k, 2 if axis == 2 else 1, 3] = place if axis == 2 else -place

    return _edited(blade, which, edit)


def _edited(blade: Blade, which: int, edit: Callable[[FloatArray, FloatArray], None]) -> Blade:
    table = blade.table
    assert table is not None
    key = ("stiffness", "mass")[which]
    onto, about = (one.copy() for one in about_centers(np.array(getattr(table, key))))
    edit(onto, about)
    made = np.swapaxes(onto, 1, 2) @ about @ onto
    return blade.with_section(replace(table, **{key: nested(made)}))


def _twisted(blade: Blade, k: int, angle: float) -> Blade:
    twist = list(blade.line.twist)  # type: ignore[arg-type]
    twist[k] = (twist[k][0], angle)
    return blade.with_twist(tuple(twist))
