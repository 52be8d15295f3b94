"""A section by its 6x6 matrices of stiffness and mass at stations along the blade.

Forces N, Q2, Q3, M1, M2, M3 and strains ε, γ2, γ3, κ1, κ2, κ3 stand in this order: axis 1 along the
blade, 2 along the chord and 3 along the thickness of the section.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal, Never, get_args

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, Profile, profile_at
from .input_checks import finite_array, finite_values, require_offset, shown, stepped
from .section import OutOfPlane, Section
from .theory import Theory

_EVEN = 1e-6  # of a matrix whose entries a table rounds
_POSITIVE = 1e-12  # least stiffness, over that of the axes alone

STIFFNESSES = ("EA", "GA2", "GA3", "GJ", "EI2", "EI3")
MASSES = ("m", "j1", "j2", "j3")

Matrix = tuple[tuple[float, ...], ...]
Interpolation = Literal["components", "matrix"]


def hat(vector: FloatArray) -> FloatArray:
    """Return the matrices (..., 3, 3) of a × for vectors (..., 3)."""
    result = np.zeros((*vector.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[..., k, j], result[..., j, k] = vector[..., i], -vector[..., i]
    return result


def moved(matrices: FloatArray, offset: FloatArray) -> FloatArray:
    """Return matrices (stations, 6, 6) for the line, from which their own axis has an offset.

    The axis has the strain Γ - a × κ and the velocity v - a × ω, a = (0, c2, c3), of a rigid
    section.
    """
    place = np.zeros((len(matrices), 3))
    place[:, 1:] = offset
    onto = np.tile(np.eye(6), (len(matrices), 1, 1))
    onto[:, :3, 3:] = -hat(place)
    return np.asarray(np.swapaxes(onto, 1, 2) @ matrices @ onto)


def _offsets(name: str, values: ArrayLike, x: FloatArray) -> FloatArray:
    """Return (c2, c3) [m] at each of the stations `x`, (stations, 2); zeros of the number 0."""
    pairs = finite_array(name, values, "m")
    if pairs.ndim == 0 and pairs == 0.0:
        return np.zeros((x.size, 2))
    if pairs.shape != (x.size, 2):
        raise ValueError(
            f"{name} must be a pair (c2, c3) [m] at each of the {x.size} stations, got the shape "
            f"{pairs.shape}: if it is the same at all, give [[c2, c3]] * {x.size}"
        )
    require_offset(name, pairs, x[-1])
    return pairs


def _table(name: str, values: ArrayLike, columns: tuple[str, ...], x: FloatArray) -> FloatArray:
    """Return columns (stations, columns) or matrices (stations, 6, 6)."""
    table = finite_array(name, values, None)
    if table.shape not in ((x.size, len(columns)), (x.size, 6, 6)):
        raise ValueError(
            f"{name} must have the columns {', '.join(columns)}, or be 6x6 matrices, at each of "
            f"the {x.size} stations, got {table.shape}"
        )
    return table


def _stiffness_of(columns: FloatArray, tension: FloatArray, shear: FloatArray) -> FloatArray:
    """Return the matrices of EA, GA2, GA3, GJ, EI2, EI3 about centers of tension and of shear."""
    axial, across = (columns * mask for mask in ([1, 0, 0, 0, 1, 1], [0, 1, 1, 1, 0, 0]))
    parts = ((axial, tension), (across, shear))
    return np.asarray(sum(moved(part[:, :, None] * np.eye(6), at) for part, at in parts))


def _mass_of(columns: FloatArray, center: FloatArray) -> FloatArray:
    """Return the matrices of m, j1, j2, j3 about centers of mass."""
    return moved(columns[:, [0, 0, 0, 1, 2, 3], None] * np.eye(6), center)


def about_centers(matrices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return T, by which strains, or velocities, are those at the centers, and T⁻ᵀ S T⁻¹.

    ε at the center of tension, where it does not couple with bending, and shear at the center of
    shear, where it does not couple with torsion; of a mass both are at its center.
    """
    onto = np.tile(np.eye(6), (len(matrices), 1, 1))
    onto[:, 0, 4:] = matrices[:, 0, 4:] / matrices[:, :1, 0]
    onto[:, 1:3, 3:4] = np.linalg.solve(matrices[:, 1:3, 1:3], matrices[:, 1:3, 3:4])
    back = 2.0 * np.eye(6) - onto
    return onto, np.swapaxes(back, 1, 2) @ matrices @ back


def section_of_table(
    x: ArrayLike,
    stiffness: ArrayLike,
    mass: ArrayLike,
    interpolation: Interpolation,
    **centers: ArrayLike,
) -> StationSection:
    """Return the section of a table of `Blade.from_stations`, about the blade's line."""
    at = finite_values("x", x, "m")
    if at.size < 2 or at[0] != 0.0:
        raise ValueError(
            f"x must be two stations or more from 0 to the length, got {at.size} from {at[0]:g} to "
            f"{at[-1]:g} m"
        )
    at = stepped("x", at)
    places = {name: _offsets(name, values, at) for name, values in centers.items()}
    S, M = _table("stiffness", stiffness, STIFFNESSES, at), _table("mass", mass, MASSES, at)
    for name, table in (("tension", S), ("shear", S), ("center", M)):
        if table.ndim == 3 and places[name].any():
            raise ValueError(
                f"{name} is a center of columns, and 6x6 matrices have theirs in them: leave it "
                "out, or give axis, which moves matrices"
            )
    if S.ndim == 2:
        S = _stiffness_of(S, places["tension"], places["shear"])
    if M.ndim == 2:
        M = _mass_of(M, places["center"])
    S, M = (moved(matrices, places["axis"]) for matrices in (S, M))
    return StationSection(
        x=tuple(at.tolist()), stiffness=nested(S), mass=nested(M), interpolation=interpolation
    )


@dataclass(frozen=True, kw_only=True)
class StationSection(Section):
    """Section by 6x6 matrices at stations; made by `Blade.from_stations`.

    Parameters
    ----------
    x : tuple
        Stations from the clamp to the tip [m].
    stiffness, mass : tuple
        6x6 matrices at these, about the blade's line in axes of the section; SI units.
    interpolation : {"components", "matrix"}
        Between stations the places of the centers and the matrices about these are linear, or the
        matrices about the line.

    Raises
    ------
    ValueError
        If a matrix is not symmetric, or not positive.
    """

    x: tuple[float, ...]
    stiffness: tuple[Matrix, ...] = field(repr=False)
    mass: tuple[Matrix, ...] = field(repr=False)
    interpolation: Interpolation = "components"
    axial_stiffness: Profile = field(init=False, repr=False)
    bending_stiffness: Profile = field(init=False, repr=False)
    mass_per_length: Profile = field(init=False, repr=False)
    rotary_inertia: Profile | None = field(init=False, repr=False)
    out_of_plane: OutOfPlane | None = field(init=False, default=None)

    @property
    def knows_space(self) -> bool:
        """True: the matrices contain it."""
        return True

    def __post_init__(self) -> None:
        if self.interpolation not in get_args(Interpolation):
            raise ValueError(
                f'interpolation must be "components" or "matrix", got {shown(self.interpolation)}'
            )
        x = finite_array("x", self.x, "m").ravel()
        S, M = (_matrices(name, x, getattr(self, name)) for name in ("stiffness", "mass"))
        for at, one in zip(x, S, strict=True):
            _require_stiffness(at, one)
        for at, one in zip(x, M, strict=True):
            _require_mass(at, one)
        bending = S[:, 5, 5] - S[:, 0, 5] ** 2 / S[:, 0, 0]  # about the center of tension
        turning = np.maximum(M[:, 5, 5] - M[:, 0, 5] ** 2 / M[:, 0, 0], 0.0)  # and that of mass
        places = tuple(x.tolist())
        EA, EI, m, j = (
            profile_at(places, one) for one in (S[:, 0, 0], bending, M[:, 0, 0], turning)
        )
        self._keep(
            x=places, stiffness=nested(S), mass=nested(M), axial_stiffness=EA,
            bending_stiffness=EI, mass_per_length=m, rotary_inertia=j,
        )  # fmt: skip
        super().__post_init__()

    @cached_property
    def _arrays(self) -> FloatArray:
        """Stiffness and mass, (2, stations, 6, 6)."""
        return np.array((self.stiffness, self.mass))

    @cached_property
    def _about_centers(self) -> FloatArray:
        """T and T⁻ᵀ S T⁻¹ of stiffness and mass, (2, 2, stations, 6, 6)."""
        return np.stack([about_centers(kind) for kind in self._arrays], axis=1)

    @cached_property
    def _linear(self) -> FloatArray:
        """T and the matrices about its centers, linear between stations; or about the line."""
        if self.interpolation == "components":
            return self._about_centers
        return np.stack((np.broadcast_to(np.eye(6), self._arrays.shape), self._arrays))

    @property
    def stiffnesses(self) -> FloatArray:
        """EA, GA2, GA3, GJ, EI2 and EI3 about their centers at the stations, (stations, 6)."""
        return np.asarray(np.einsum("sii->si", self._about_centers[1, 0]))

    def matrices(self, x: FloatArray) -> FloatArray:
        """Return stiffness and mass at `x` between stations, in their unit, (2, places, 6, 6)."""
        at = np.array(self.x)
        first = np.minimum(np.searchsorted(at, x, side="right"), at.size - 1) - 1
        share = ((x - at[first]) / np.diff(at)[first])[:, None, None]
        ends = self._linear
        onto, about = (1.0 - share) * ends[:, :, first] + share * ends[:, :, first + 1]
        return np.asarray(np.swapaxes(onto, -1, -2) @ about @ onto)

    @cached_property
    def is_planar(self) -> bool:
        """Whether no entry couples motion in the plane, with centers off the line, or leaves it."""
        others = ((0,), (1, 2, 3, 4, 5)), ((5,), (1, 2, 3, 4)), ((1,), (2, 3, 4))
        return not any(self.couples(one, other) for one, other in others)

    def needs_space(self, theory: Theory) -> bool:
        """Whether shear, or flap that twists, is given beyond what the Hill equation takes."""
        sheared = theory.shear is not None and not theory.engesser
        return sheared or self.couples((3,), (2, 4)) or self.couples((2,), (4,))

    @property
    def shear_stiffness(self) -> Profile:
        """GA2 at the stations [N]."""
        return profile_at(self.x, self.stiffnesses[:, 1])

    def cuts(self, length: float) -> tuple[float, ...]:
        """Return the stations over the length, unless the matrices are the same at all."""
        alike = len(set(self.stiffness)) == len(set(self.mass)) == 1
        return () if alike else tuple(x / length for x in self.x)

    def couples(self, one: tuple[int, ...], other: tuple[int, ...]) -> bool:
        """Whether an entry of any matrix couples two sets of axes."""
        return bool(self._arrays[:, :, one][..., other].any())

    @property
    def inertia_against_torsion(self) -> Profile:
        """Inertia about the line at the stations [kg m]."""
        return profile_at(self.x, self._arrays[1, :, 3, 3])

    def of_unit_mass(self) -> StationSection:
        """Return the section with one unit of mass per length on its line, and no inertia."""
        one = nested(np.diag([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])[None])
        return replace(self, mass=one * len(self.x))

    def in_units(self, length: float, mass: float, time: float) -> StationSection:
        """Return the section in units of length [m], mass [kg] and time [s]."""
        lever = np.repeat([1.0, length], 3)
        units = np.multiply.outer(lever, lever)
        force = mass * length / time**2
        stiffness, inertia = self._arrays / units
        return StationSection(
            x=tuple(x / length for x in self.x),
            stiffness=nested(stiffness / force),
            mass=nested(inertia * length / mass),
            interpolation=self.interpolation,
        )

    def tapered(self, width: float, height: float) -> Never:
        """Refuse a taper."""
        del width, height
        raise ValueError("the stations define how the section varies: scale their values")

    def with_out_of_plane(self, out_of_plane: OutOfPlane | None) -> Never:
        """Refuse ratios, which the matrices contain."""
        del out_of_plane
        raise ValueError("the stations define the section out of the plane: change their values")


def nested(matrices: FloatArray) -> Any:
    """Return matrices (stations, 6, 6) as tuples, so that they hash."""
    return tuple(tuple(map(tuple, one)) for one in matrices.tolist())


def _matrices(name: str, x: FloatArray, values: ArrayLike) -> FloatArray:
    """Return symmetric matrices (stations, 6, 6)."""
    matrices = finite_array(name, values)
    if matrices.shape != (x.size, 6, 6):
        raise ValueError(
            f"{name} must be a 6x6 matrix at each of the {x.size} stations, got {matrices.shape}"
        )
    size = np.sqrt(np.abs(np.einsum("sii->si", matrices)))
    off = np.abs(matrices - np.swapaxes(matrices, 1, 2))
    over = off - _EVEN * size[:, :, None] * size[:, None]
    if over.max() > 0.0:
        k, i, j = np.unravel_index(np.argmax(over), over.shape)
        raise ValueError(
            f"{name} at x = {x[k]:g} m is not symmetric: entries ({i + 1}, {j + 1}) and "
            f"({j + 1}, {i + 1}) are {matrices[k, i, j]:g} and {matrices[k, j, i]:g}"
        )
    return np.asarray(0.5 * (matrices + np.swapaxes(matrices, 1, 2)))


def _require_stiffness(x: float, stiffness: FloatArray) -> None:
    for name, value in zip(STIFFNESSES, np.diag(stiffness).tolist(), strict=True):
        if value <= 0.0:
            raise ValueError(f"stiffness at x = {x:g} m has {name} = {value:g}: give it above zero")
    size = np.sqrt(np.diag(stiffness))
    least = float(np.linalg.eigvalsh(stiffness / np.outer(size, size))[0])
    if least < _POSITIVE:
        raise ValueError(
            f"stiffness at x = {x:g} m is not positive definite: over its diagonal its least "
            f"eigenvalue is {least:.3g}; lower the entries off the diagonal"
        )


def _require_mass(x: float, mass: FloatArray) -> None:
    m, carried = mass[0, 0], mass[3:, :3]
    if m <= 0.0:
        raise ValueError(f"mass at x = {x:g} m is {m:g} kg/m: give it above zero")
    off = np.abs(np.concatenate((mass[:3, :3] - m * np.eye(3), 0.5 * (carried + carried.T))))
    if np.any(off > _EVEN * np.repeat([m, np.abs(carried).max()], 3)[:, None]):
        raise ValueError(
            f"mass at x = {x:g} m is not that of a rigid section: {off.max():.3g} too much in an "
            "entry; give m on the first three of the diagonal, zero between, m c × off the diagonal"
        )
    about = mass[3:, 3:] + carried @ carried / m
    least = float(np.linalg.eigvalsh(about)[0])
    if least < -_EVEN * max(float(np.trace(mass[3:, 3:])), 0.0):
        raise ValueError(
            f"mass at x = {x:g} m has a moment of inertia of {least:.3g} kg m about its center of "
            "mass: let it be zero or more, or the center nearer to the line"
        )
