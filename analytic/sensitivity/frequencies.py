"""Derivatives of frequencies to the numbers of a blade."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.space import SpaceContinuum
from ..exact.continuum.state import Driven
from ..exact.continuum.vectors import cross
from ..exact.linear.families import LinearModes
from ..exact.linear.modes import linear_modes
from ..input_checks import shown
from ..theory import Theory
from ..threads import one_thread
from .frozen import Kernels, frozen
from .parameters import Parameter, parameters_of

_SWING = 5e-3  # of strains of energy one: of sums of squares the fourth power is left
_PHASES = 8  # in a period: averages are exact up to the seventh harmonic
_CHANGE = 3e-3  # of a parameter over its size: of the fourth power is left
_STIFF, _SAME = 1e4, 1e-4  # EI out of the plane over that in it, and what it may change
_AROUND = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
_AHEAD = np.array([0.0, 1.0, 2.0]), np.array([-1.5, 2.0, -0.5])


@dataclass(frozen=True)
class Sensitivity:
    """How frequencies change with the numbers of a blade.

    Attributes
    ----------
    modes : LinearModes
    parameters : tuple of Parameter
    derivatives : ndarray (modes, parameters)
        Of the frequencies [rad/s] to the parameters, in their units.
    """

    modes: LinearModes
    parameters: tuple[Parameter, ...] = field(repr=False)
    derivatives: FloatArray = field(repr=False)

    @property
    def blade(self) -> Blade:
        """The modes' blade."""
        return self.modes.blade

    @property
    def omega(self) -> float:
        """Their rotation speed [rad/s]."""
        return self.modes.omega

    @property
    def theory(self) -> Theory:
        """Their theory."""
        return self.modes.theory

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(one.name for one in self.parameters)

    @property
    def relative(self) -> FloatArray:
        """Relative change of a frequency over that of a parameter, p/ω ∂ω/∂p.

        Zero where the parameter is zero, (modes, parameters).
        """
        now = np.array([one.value for one in self.parameters])
        return np.asarray(self.derivatives * now / self.modes.frequencies[:, None])

    def of(self, mode: str, parameter: str) -> float:
        """Return one derivative by names."""
        for name, among in ((mode, self.modes.names), (parameter, self.names)):
            if name not in among:
                raise ValueError(f"there is no {shown(name)}: known are {', '.join(among)}")
        row, column = self.modes.names.index(mode), self.names.index(parameter)
        return float(self.derivatives[row, column])


@one_thread
def sensitivity(modes: LinearModes, parameters: Iterable[str] | None = None) -> Sensitivity:
    """Return how the frequencies of modes change with the numbers of their blade.

    By the modes' own tangent, with the steady state's change, at the same speed; no mode is solved
    anew. In the plane of bending alone where the section out of it is unknown.

    Parameters
    ----------
    modes : LinearModes
        Of `linear_modes`; one that meets another at its frequency has no derivative.
    parameters : iterable of str, optional
        Names out of `parameters_of`; all, unless given.

    Raises
    ------
    ValueError
        If the blade has no parameter of a name.

    Examples
    --------
    >>> from analytic import Beam, Theory, linear_modes
    >>> from analytic.sensitivity import sensitivity
    >>> modes = linear_modes(Beam.reference(), omega=6.0, theory=Theory(extension=False))
    >>> found = sensitivity(modes, ["EI3", "m"])
    >>> print(found.relative.round(3))
    [[ 0.341 -0.341]
     [ 0.314 -0.314]
     [ 0.407 -0.407]]
    """
    if isinstance(parameters, str):
        raise TypeError(f"parameters must be names, as [{parameters!r}], got {parameters!r}")
    found = _Derivatives(modes)
    known = {name: found.parameters[name] for name in parameters_of(modes.blade, modes.theory)}
    names = list(known if parameters is None else parameters)
    if unknown := [name for name in names if name not in known]:
        raise ValueError(
            f"the blade has no parameter {', '.join(map(shown, unknown))}; it has "
            f"{', '.join(known)}"
        )
    several = [known[name] for name in names]
    columns = [found.to(one) for one in several]
    return Sensitivity(
        modes=modes,
        parameters=tuple(several),
        derivatives=np.reshape(columns, (len(several), len(modes.names))).T,
    )


def require_modes(modes: object) -> None:
    """Refuse all but `LinearModes`."""
    if not isinstance(modes, LinearModes):
        raise TypeError(f"modes must be what linear_modes returns, got {shown(modes)}")


class _Derivatives:
    """Derivatives of frequencies, from energies in states around the steady one."""

    def __init__(self, modes: LinearModes) -> None:
        modes = in_space(modes)
        self.blade, steady = modes.blade, modes.steady
        self.model: SpaceContinuum = steady.model
        self.by, self.still = Driven(steady.rate), steady.equilibrium
        _, K, C, M = (part[0] for part in steady.linearized)
        size = np.sqrt(np.einsum("kn,kn->k", modes.coordinates.conj(), modes.coordinates @ K).real)
        self.shapes = modes.coordinates / size[:, None]
        self.frequencies = modes.frequencies / self.blade.frequency_scale
        # Of φ'Dφ with D = K + iΩC - Ω²M, whose zero is the frequency.
        self.slopes = np.array([
            (shape.conj() @ (1j * C - 2.0 * w * M) @ shape).real
            for w, shape in zip(self.frequencies, self.shapes, strict=True)
        ])  # fmt: skip
        shifts = [np.linalg.solve(K, self._second_order(k)) for k in range(len(self.shapes))]
        self.states = [self._around(k, shift, K) for k, shift in enumerate(shifts)]
        self.squares = np.stack([
            2.0 * np.outer(shape, shape.conj()).real
            - np.outer(shift, self.still) - np.outer(self.still, shift)
            for shape, shift in zip(self.shapes, shifts, strict=True)
        ])  # fmt: skip
        self.kernels = self._kernels()
        self.parameters = parameters_of(self.blade, modes.theory)
        self._known, self._at = dict[str, FloatArray](), dict[str, FloatArray]()

    def _swings(self, k: int, size: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return a mode's q, q̇ and q̈ about the steady state over a period."""
        w, phases = self.frequencies[k], 2.0 * math.pi * np.arange(_PHASES) / _PHASES
        moved = size * np.exp(1j * phases)[:, None] * self.shapes[k]
        return self.still + moved.real, (1j * w * moved).real, (-(w**2) * moved).real

    def _second_order(self, k: int) -> FloatArray:
        """Return the mean force of a mode's swing, four times of its square: φ'(∂D/∂q)φ."""
        none = np.zeros((1, self.still.size))
        (at_rest,) = self.model.residual(self.still[None], none, none, self.by)
        once, twice = (
            4.0 * (self.model.residual(*self._swings(k, h), self.by).mean(axis=0) - at_rest) / h**2
            for h in (_SWING, 2.0 * _SWING)
        )
        return np.asarray((4.0 * once - twice) / 3.0)

    def _around(
        self, k: int, shift: FloatArray, K: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return states q, q̇, q̈ and their weights.

        Sums of energies are φ'Dφ, and what the change of the steady state adds to it.
        """
        swings = [self._swings(k, h) for h in (_SWING, 2.0 * _SWING)]
        length = math.sqrt(float(shift @ K @ shift)) or 1.0
        along, of_slope = _AROUND
        rest = self.still + np.outer(np.append(0.0, _SWING / length * along), shift)
        none = np.zeros_like(rest)
        each = 4.0 / (_PHASES * _SWING**2)
        squares = np.repeat([4.0 / 3.0 * each, -each / 12.0], _PHASES)
        weights = (squares, [-squares.sum()], -of_slope * length / _SWING)
        states = zip(*swings, (rest, none, none), strict=True)
        q, q_dot, q_ddot = map(np.concatenate, states)
        return q, q_dot, q_ddot, np.concatenate(weights)

    def _kernels(self) -> Kernels:
        strains = self.model.strains
        fields = np.concatenate((strains.gamma, strains.K))
        sums: list[list[FloatArray]] = []
        for q, q_dot, q_ddot, weights in self.states:
            velocity, spin, turn, clamp = self.model.velocities(q, q_dot, self.by)
            moved = np.concatenate((velocity, spin))
            force = self.model.on_strains(q, q_dot, q_ddot, self.by)[:3]
            strained = np.einsum("ipn,sn->isp", fields, q)
            sums.append([
                *(
                    np.einsum("s,isp,jsp->pij", weights, one, one, optimize=True)
                    for one in (moved, turn, clamp)
                ),
                weights @ (force[0] * self.model.shortening(q)),
                weights @ (force[0] * strains.trapeze * strained[3]),
                np.einsum("s,isp,jsp->pij", weights, force, strained, optimize=True),
            ])  # fmt: skip
        return Kernels(
            np.einsum("ipm,kmn,jpn->kpij", fields, self.squares, fields, optimize=True),
            *(np.stack(kind) for kind in zip(*sums, strict=True)),
        )

    def _with(self, blade: Blade) -> FloatArray:
        """Return the parts of φ'Dφ of all modes, (modes, points and masses), in another blade.

        Of one whose unloaded line is that of the solution's.
        """
        functions = frozen(self.model.functions, self.blade, blade)
        return np.concatenate(self.kernels.energies(functions), axis=1)

    def _with_moved(self, blade: Blade) -> FloatArray:
        """Return the same in any blade."""
        model = SpaceContinuum(frozen(self.model.functions, self.blade, blade))
        masses, stiffness = model.masses, model.functions.stiffness
        sums = []
        for (q, q_dot, _, weights), squares in zip(self.states, self.squares, strict=True):
            velocity, spin, turn, clamp = model.velocities(q, q_dot, self.by)
            moved = velocity + cross(spin, masses.offset[:, None])
            twice = np.sum(moved**2, axis=0) @ masses.mass
            twice += np.einsum("isp,ijp,jsp->s", turn, masses.inertia, turn, optimize=True)
            twice += np.einsum("isp,ijp,jsp->s", clamp, masses.carried, clamp, optimize=True)
            sums.append(0.5 * np.sum(squares * stiffness) - 0.5 * weights @ twice)
        return np.array(sums)

    def _change(self, parameter: Parameter, energies: Callable[[Blade], FloatArray]) -> FloatArray:
        """Return the derivative of energies to a parameter."""
        change = _CHANGE * parameter.size
        ahead = parameter.value - 2.0 * change < parameter.least
        steps, weights = _AHEAD if ahead else _AROUND
        values = [energies(parameter.changed(parameter.value + change * step)) for step in steps]
        return np.asarray(np.tensordot(weights, values, 1) / change)

    def _parts(self, parameter: Parameter) -> FloatArray:
        """Return the same of all parts along the blade, (modes, parts), kept for stations."""
        if parameter.name not in self._known:
            self._known[parameter.name] = self._change(parameter, self._with)
        return self._known[parameter.name]

    def _at_stations(self, family: str) -> FloatArray:
        """Return the derivatives to a family of numbers at all stations, (modes, stations).

        A section has those of the stations beside it, between which they are linear.
        """
        table = self.blade.table
        assert table is not None
        x, grid = np.array(table.x) / self.blade.length, self.model.points
        places = np.concatenate((grid, self.model.masses.places))
        share = np.array([np.interp(places, x, one) for one in np.eye(x.size)])
        whole = self.parameters[family]
        if whole.value:  # a factor, of what is between stations
            at = [self.parameters[f"{family}[{k}]"].value for k in range(x.size)]
            share /= np.interp(places, x, at)
        slopes = self._parts(whole) @ share.T
        if family == "setting_angle":
            steps = np.diff(np.eye(x.size), axis=1) / np.diff(x)
            cell = np.clip(np.searchsorted(x, grid, side="right") - 1, 0, x.size - 2)
            slopes += self.kernels.twisted @ steps[:, cell].T
        return np.asarray(slopes)

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all frequencies [rad/s] to a parameter."""
        table = self.blade.table
        if parameter.moves:
            slope = self._change(parameter, self._with_moved)
        elif parameter.family and table and table.interpolation == "components":
            family = parameter.family
            if family not in self._at:
                self._at[family] = self._at_stations(family)
            slope = self._at[family][:, parameter.station]
        else:
            slope = self._parts(parameter).sum(axis=1)
        return np.asarray(-self.blade.frequency_scale * slope / self.slopes)


def in_space(modes: LinearModes) -> LinearModes:
    """Return modes in space; of a blade known in its plane, with a large stiffness out of it."""
    require_modes(modes)
    if isinstance(modes.model, SpaceContinuum):
        return modes
    blade, count = modes.blade.with_section_out_of_plane(_STIFF, math.inf), len(modes.names)
    several = linear_modes(blade, modes.omega, count, theory=modes.theory)
    off = np.abs(several.frequencies / modes.frequencies - 1.0).max()
    if off > _SAME:
        raise ValueError(
            f"with a stiff section out of its plane the blade has other modes, by {off:.1g}: give "
            "the section by with_section_out_of_plane"
        )
    return several
