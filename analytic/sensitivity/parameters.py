"""The numbers of a blade by name, each with the blade that has another value of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ..arrays import FloatArray, in_units
from ..blade import Blade
from ..blade_checks import require_blade
from ..input_checks import shown
from ..station_section import MASSES, STIFFNESSES, StationSection, about_centers, hat, nested
from ..theory import Theory, require_theory

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
        From another value to the blade that has it; of a factor or a shift of all a table also from
        one for each station. Of a condition to its motion and loads.
    moves : bool
        Whether it moves the unloaded blade, or its clamp.
    family : str
        At a station: the parameter that changes the same at all stations, as "EI3".
    station : int
        k of a station.
    least : float
        The value is not below.
    """

    name: str
    value: float
    unit: str
    size: float
    changed: Callable[[Any], Any] = field(repr=False)
    moves: bool = False
    family: str = ""
    station: int = 0
    least: float = -math.inf

    @property
    def step(self) -> float:
        """A small change: of an angle a degree, else a hundredth of the size."""
        return math.radians(1.0) if self.unit == "rad" else 0.01 * self.size

    @property
    def change(self) -> str:
        """The same in words, as "+1 %"."""
        return self.changed_by(1.0)

    def changed_by(self, steps: float) -> str:
        """Return a change by some steps in words."""
        if self.unit == "rad":
            return f"{math.degrees(steps * self.step):+.3g} deg"
        if self.unit in ("m", "rad/s"):
            return f"{steps * self.step:+.3g} {self.unit}"
        return f"{steps:+.2g} %"


def parameters_of(blade: Blade, theory: Theory) -> dict[str, Parameter]:
    """Return the parameters of a blade by name, those of its stations last.

    EA, EI3 (in the plane of bending at the setting angle zero), EI2, GJ, m and j, the rotary
    inertia, are factors for all the blade; `hub_radius`, `setting_angle` and `precone`;
    `point_mass[k]`; `damping_bending` and so on, factors of the coefficients. Of a table all
    stiffnesses and masses about their centers, and by `tension2`, `center3` and so on a shift of
    the centers of tension and mass along axis 2 or 3; each of these and the twist at every station,
    as `EI3[4]`.

    Examples
    --------
    >>> from analytic import Beam, Theory
    >>> from analytic.sensitivity import parameters_of
    >>> print(*parameters_of(Beam.reference().with_tip_mass(0.1), Theory()))
    EA EI3 m hub_radius setting_angle point_mass[0]
    """
    require_blade(blade)
    require_theory(theory)
    found = _of_table(blade, blade.table, theory) if blade.table else _of_section(blade)
    return {one.name: one for one in found}


def parameters_by(
    what: str, names: Iterable[str], known: Mapping[str, Parameter]
) -> list[Parameter]:
    """Return parameters by their names, refusing those that are not known."""
    if isinstance(names, str):
        raise TypeError(f"{what} must be names, as [{names!r}], got {names!r}")
    several = list(names)
    if unknown := [name for name in several if name not in known]:
        raise ValueError(
            f"the blade has no parameter {', '.join(map(shown, unknown))}; it has "
            f"{', '.join(known)}"
        )
    return [known[name] for name in several]


def _of_section(blade: Blade) -> Iterator[Parameter]:
    # Its shear stiffness goes with EA.
    section, out = blade.section, blade.section.out_of_plane
    profiles = {"EA": "axial_stiffness", "EI3": "bending_stiffness", "m": "mass_per_length"}
    if section.rotary_inertia is not None:
        profiles["j"] = "rotary_inertia"
    for name, key in profiles.items():
        yield factor_of(name, partial(_scaled, blade, key))
    if out is not None:
        for name, key in (("EI2", "bending_ratio"), ("GJ", "torsion_ratio")):
            if np.isfinite(getattr(out, key) or np.inf):
                yield factor_of(name, partial(_other_ratio, blade, key))
    yield from _of_line(blade)


def factor_of(name: str, changed: Callable[[float], Any]) -> Parameter:
    """Return the parameter that multiplies what there is."""
    return Parameter(name, 1.0, "1", 1.0, changed)


def _scaled(blade: Blade, key: str, factor: float) -> Blade:
    change: dict[str, Any] = {key: in_units(getattr(blade.section, key), 1.0, 1.0 / factor)}
    section = replace(blade.section, **change)
    if key == "bending_stiffness" and (out := section.out_of_plane) is not None:
        # The same stiffness out of the plane, over another one in it.
        torsion = None if out.torsion_ratio is None else out.torsion_ratio / factor
        out = replace(out, bending_ratio=out.bending_ratio / factor, torsion_ratio=torsion)
        section = replace(section, out_of_plane=out)
    return blade.with_section(section)


def _other_ratio(blade: Blade, key: str, factor: float) -> Blade:
    out = blade.section.out_of_plane
    assert out is not None
    ratio = {key: factor * getattr(out, key)}
    return blade.with_section(replace(blade.section, out_of_plane=replace(out, **ratio)))


def _of_line(blade: Blade) -> Iterator[Parameter]:
    """Yield what the blade has besides its sections."""
    radius, angle, cone = blade.hub_radius, blade.setting_angle, blade.line.precone
    yield Parameter(
        "hub_radius", radius, "m", blade.length, blade.with_hub_radius, moves=True, least=0.0
    )
    yield Parameter("setting_angle", angle, "rad", _TURN, partial(_set_at, blade), moves=True)
    if blade.section.knows_space:
        yield Parameter("precone", cone, "rad", _TURN, blade.with_precone, moves=True)
    for k, one in enumerate(blade.point_masses):
        yield Parameter(
            f"point_mass[{k}]", one.mass, "kg", one.mass, partial(_other_mass, blade, k)
        )

    for name, value in vars(blade.damping).items():
        if value:
            yield factor_of(f"damping_{name}", partial(_other_damping, blade, name, value))


def _other_damping(blade: Blade, name: str, value: float, factor: float) -> Blade:
    return blade.with_damping(replace(blade.damping, **{name: factor * value}))


def _other_mass(blade: Blade, k: int, mass: float) -> Blade:
    masses = list(blade.point_masses)
    masses[k] = replace(masses[k], mass=mass)
    return replace(blade, point_masses=tuple(masses))


def _of_table(blade: Blade, table: StationSection, theory: Theory) -> Iterator[Parameter]:
    stations: list[Parameter] = []
    entries = [(0, n) for n in STIFFNESSES if theory.shear is not None or not n.startswith("GA")]
    (S_onto, S), (M_onto, M) = (about_centers(np.array(of)) for of in (table.stiffness, table.mass))
    for which, name in (*entries, *((1, n) for n in MASSES)):
        diagonals = np.einsum("sii->si", (S, M)[which])
        values = diagonals[:, _places(which, name)[0]].tolist()
        if all(values):
            yield factor_of(name, partial(_entry, blade, which, name, slice(None)))
            stations += [
                Parameter(
                    f"{name}[{k}]", value, _UNITS[name], value,
                    partial(_other_entry, blade, which, name, k, value), family=name, station=k,
                )
                for k, value in enumerate(values)
            ]  # fmt: skip
    for which, name, onto in ((0, "tension", S_onto), (1, "center", M_onto)):
        for axis in (2, 3):
            family, size = f"{name}{axis}", _SMALL * blade.length
            yield Parameter(family, 0.0, "m", size, partial(_shifted, blade, which, axis))
            stations += [
                Parameter(
                    f"{family}[{k}]", value, "m", size,
                    partial(_centered, blade, which, axis, k), family=family, station=k,
                )
                for k, value in enumerate(_centers_of(onto)[:, axis - 1].tolist())
            ]  # fmt: skip
    yield from _of_line(blade)
    yield from stations
    twist: Any = blade.line.twist
    if np.shape(twist) == (len(table.x), 2):
        bent = bool(blade.line.prebend or blade.line.sweep or blade.line.kinks)
        for k, (_, angle) in enumerate(twist):
            yield Parameter(
                f"twist[{k}]", angle, "rad", _TURN, partial(_twisted, blade, k), moves=bent,
                family="setting_angle", station=k,
            )  # fmt: skip


def _places(which: int, name: str) -> list[int]:
    """Return the entries of a matrix about its centers; the mass is there for each direction."""
    if which == 0:
        return [STIFFNESSES.index(name)]
    return [0, 1, 2] if name == "m" else [2 + MASSES.index(name)]


def _entry(blade: Blade, which: int, name: str, at: int | slice, factor: Any) -> Blade:
    """Return the blade with a multiple of an entry of its matrices about their centers.

    At all stations by one factor, or by one for each.
    """

    def edit(onto: FloatArray, about: FloatArray) -> None:
        del onto
        more = np.zeros((*np.shape(factor), 6))
        more[..., _places(which, name)] = np.asarray(factor)[..., None] - 1.0
        about[at] += about[at] * np.eye(6) * more[..., None, :]

    return _edited(blade, which, edit)


def _other_entry(blade: Blade, which: int, name: str, k: int, now: float, value: float) -> Blade:
    return _entry(blade, which, name, k, value / now)


def _centers_of(onto: FloatArray) -> FloatArray:
    """Return the centers (0, c2, c3) of what takes strains or velocities to them, (stations, 3)."""
    return np.stack((np.zeros(len(onto)), -onto[:, 0, 5], onto[:, 0, 4]), axis=1)


def _shifted(blade: Blade, which: int, axis: int, change: Any) -> Blade:
    """Return the blade with all centers moved along an axis, the same or by one for each."""
    return _edited(blade, which, lambda onto, _: _move(onto, which, axis, slice(None), change))


def _centered(blade: Blade, which: int, axis: int, k: int, place: float) -> Blade:
    """Return the blade with one center at another place along an axis."""

    def edit(onto: FloatArray, about: FloatArray) -> None:
        del about
        _move(onto, which, axis, k, place - _centers_of(onto)[k, axis - 1])

    return _edited(blade, which, edit)


def _move(onto: FloatArray, which: int, axis: int, at: int | slice, change: Any) -> None:
    """Move centers in place: of tension for the strain along, of mass for all velocities."""
    centers = _centers_of(onto)
    centers[at, axis - 1] += change
    rows = slice(3) if which else slice(1)
    onto[:, rows, 3:] = -hat(centers)[:, rows]


def _edited(blade: Blade, which: int, edit: Callable[[FloatArray, FloatArray], None]) -> Blade:
    table = blade.table
    assert table is not None
    key = ("stiffness", "mass")[which]
    onto, about = (one.copy() for one in about_centers(np.array(getattr(table, key))))
    edit(onto, about)
    made = np.swapaxes(onto, 1, 2) @ about @ onto
    return blade.with_section(replace(table, **{key: nested(made)}))


def _set_at(blade: Blade, angle: Any) -> Blade:
    """Return the blade set at an angle, or at one for each station of its twist."""
    if not np.ndim(angle):
        return blade.with_setting_angle(angle)
    profile: Any = blade.line.twist
    more = (np.asarray(angle) - blade.setting_angle).tolist()
    return blade.with_twist(
        tuple((x, own + change) for (x, own), change in zip(profile, more, strict=True))
    )


def _twisted(blade: Blade, k: int, angle: float) -> Blade:
    profile: Any = blade.line.twist
    twist = list(profile)
    twist[k] = (twist[k][0], angle)
    return blade.with_twist(tuple(twist))
