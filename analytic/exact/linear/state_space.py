"""The linearized blade at a steady state: matrices A, B, C and D of its lowest modes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import points_of_beam, rotation_speed, whole_number
from ...lazily import linalg
from ...loads import Load, loads_at_once
from ...settled import require_tolerance, settled
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..continuum.discretization import FUNCTIONS
from ..continuum.discretization import space_continuum as continuum
from ..continuum.loading import unit_load
from ..continuum.rotation import SteadyBlade, finer_blades, rotating_blade
from ..continuum.state import Driven

OUTPUTS = tuple(f"{kind}_{axis}" for kind in ("place", "turn", "force", "moment") for axis in "xyz")
_STEP = 1e-5  # of a mode of unit elastic energy, to both sides


@dataclass(frozen=True, kw_only=True)
class StateSpace:
    """ż = A z + B u, y = C z + D u of small motion about a steady state; made by `state_space`.

    Attributes
    ----------
    blade, omega, inputs, loads, theory : as given
    x : ndarray (points,)
        Material points of the outputs [m].
    A : ndarray (2 modes, 2 modes)
        Each mode has a block [[σ, -ω], [ω, σ]], λ = σ + iω [1/s], ascending in |λ|. A state is in
        units of a mode with the elastic energy EI/L.
    B : ndarray (2 modes, inputs)
        u are times of the loads `inputs`, besides those that act already.
    C : ndarray (points, 12, 2 modes)
        y are changes by `OUTPUTS`: place [m] and turn [rad] in the frame that turns with the clamp,
        along it, in the direction of rotation and normal to both; force [N] and moment [N m] in the
        section's own axes.
    D : ndarray (points, 12, inputs)
        What the modes left out carry, as at rest: static responses are exact.
    eigenvalues : ndarray (modes,)
        λ with ω > 0 [1/s]; those of damping are `damping_ratios`.
    error : float
        Change of λ over |λ| by the last refinement.
    """

    blade: Blade
    omega: float
    inputs: tuple[Load, ...]
    loads: tuple[Load, ...]
    theory: Theory
    x: FloatArray
    A: FloatArray = field(repr=False)
    B: FloatArray = field(repr=False)
    C: FloatArray = field(repr=False)
    D: FloatArray = field(repr=False)
    eigenvalues: ComplexArray
    error: float

    def response(self, frequency: float) -> ComplexArray:
        """Return C (iν - A)⁻¹ B + D at a frequency ν [rad/s], (points, 12, inputs)."""
        turning = 1j * frequency * np.eye(len(self.A)) - self.A
        return np.asarray(self.C @ np.linalg.solve(turning, self.B) + self.D)


@one_thread
def state_space(
    blade: Blade,
    omega: float,
    inputs: Sequence[Load],
    *,
    x: ArrayLike | None = None,
    modes: int = 6,
    loads: Sequence[Load] = (),
    theory: Theory = BERNOULLI_EULER,
    tolerance: float | None = None,
) -> StateSpace:
    """Return the blade linearized about its steady state, damped or not, by its lowest modes.

    Parameters
    ----------
    blade : Blade
        With the stiffness of its section out of the plane.
    omega : float
        Rotation speed ω [rad/s].
    inputs : sequence of loads
        Each as it is at t = 0, in the frame that turns; its factor is the input.
    x : array_like, optional
        Material points of the outputs [m], from 0 to L; the tip unless given.
    modes : int
        Number of modes.
    loads : sequence of loads
        What acts in the steady state, as in `steady_state`.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.
    tolerance : float, optional
        Largest change of the eigenvalues by the last refinement, relative; by default 1e-9, of a
        blade from stations 1e-6. Short of it a warning comes with the answer.

    Raises
    ------
    ValueError
        If there is no input, an eigenvalue is real, or `steady_state` would raise it.

    Examples
    --------
    >>> from analytic import Beam, PointLoad, state_space
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08)
    >>> made = state_space(blade, 6.0, [PointLoad(force=(0.0, 1.0, 0.0))], modes=2)
    >>> print(made.A.shape, made.B.shape, made.C.shape)
    (4, 4) (4, 1) (1, 12, 4)
    """
    omega, modes = rotation_speed(omega), whole_number("modes", modes)
    warn_if_rpm(blade, omega)
    inputs, loads = loads_at_once(inputs), loads_at_once(loads)
    if not inputs:
        raise ValueError("state_space needs one input at least, as [PointLoad(force=(0, 1, 0))]")
    at = points_of_beam("x", blade.length if x is None else x, blade.length)
    model = continuum(blade, theory, max(FUNCTIONS, 2 * modes + 4), [*loads, *inputs])
    first = rotating_blade(blade, omega, model, loads=tuple(unit_load(blade, of) for of in loads))
    _, (steady, found), error = settled(
        lambda one: (one, _modes_of(one, modes)),
        finer_blades(first, lambda one: one.resolving(modes)),
        require_tolerance(tolerance, model.tolerance),
        lambda one: np.stack((np.log(np.abs(one[1][0])), np.angle(one[1][0]))),
        f"the eigenvalues at omega = {omega:g} rad/s",
        "ask for fewer modes, or rotate slower",
    )
    return StateSpace(
        blade=blade, omega=omega, inputs=inputs, loads=loads, theory=theory, x=blade.length * at,
        error=error, **_matrices(blade, steady, inputs, at, *found),
    )  # fmt: skip


def _modes_of(steady: SteadyBlade, count: int) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return λ, their shapes (n, count), and what gives their motion of q = K⁻¹F, (count, n).

    By z = P ż for z = (q, q̇), whose largest eigenvalues 1/λ are the lowest modes.
    """
    _, K, C, M = (part[0] for part in steady.linearized)
    n = len(K)
    companion = np.zeros((2 * n, 2 * n))
    companion[:n] = -linalg.solve(K, np.hstack((C, M)))
    companion[n:, :n] = np.eye(n)
    found: Any = linalg.eig(companion, left=True)
    inverse, left, right = found
    upper = np.flatnonzero(inverse.imag < 0.0)
    chosen = upper[np.argsort(-np.abs(inverse[upper]))][:count]
    slow = np.abs(inverse[chosen[-1]]) if chosen.size else 0.0
    if chosen.size < count or (np.abs(inverse[inverse.imag == 0.0]) > slow).any():
        raise ValueError(
            f"of the {count} lowest modes some do not swing: take less damping or fewer modes"
        )
    shapes, given = right[:n, chosen], left[:, chosen].conj().T
    given = given / np.sum(given * right[:, chosen].T, axis=1)[:, None]
    energy = np.einsum("ik,ij,jk->k", shapes.conj(), steady.model.functions.stiffness, shapes)
    size = np.sqrt(0.5 * energy.real)
    return 1.0 / inverse[chosen], shapes / size, given[:, :n] * size[:, None]


def _matrices(
    blade: Blade,
    steady: SteadyBlade,
    inputs: Sequence[Load],
    at: FloatArray,
    values: ComplexArray,
    shapes: ComplexArray,
    given: ComplexArray,
) -> dict[str, Any]:
    """Return A, B, C, D and the eigenvalues, with units."""
    q, others = steady.equilibrium, steady.loads
    acting = [
        SteadyBlade(steady.model, steady.rate, loads=(*others, unit_load(blade, one)))
        for one in inputs
    ]
    still = np.zeros((1, q.size))
    pushed = np.array([one.residual(q[None], still, still)[0] for one in acting])
    at_rest = steady.residual(q[None], still, still)[0]
    static = linalg.solve(steady.linearized.stiffness[0], (at_rest - pushed).T)
    for load, bent in zip(inputs, static.T, strict=True):
        if not bent.any():
            raise ValueError(f"{load} moves nothing at t = 0 in the turning frame: it is no input")
    seen = partial(_seen, blade, steady, at)
    motions = [
        shape * np.array([1.0, value, value**2])[:, None]
        for value, shape in zip(values, shapes.T, strict=True)
    ]
    by_modes = np.stack([seen(*one.real) + 1j * seen(*one.imag) for one in motions], axis=-1)
    none = np.zeros_like(q)
    by_inputs = np.stack(
        [seen(bent, none, none, one.by()) for bent, one in zip(static.T, acting, strict=True)],
        axis=-1,
    )
    moved = given @ static
    per_second = blade.frequency_scale * values
    A = linalg.block_diag(*(np.array([[v.real, -v.imag], [v.imag, v.real]]) for v in per_second))
    pull = -per_second[:, None] * moved
    return {
        "A": A,
        "B": np.stack((pull.real, pull.imag), axis=1).reshape(len(A), -1),
        "C": np.stack((2.0 * by_modes.real, -2.0 * by_modes.imag), axis=-1).reshape(
            *by_modes.shape[:2], len(A)
        ),
        "D": by_inputs - 2.0 * (by_modes @ moved).real,
        "eigenvalues": per_second,
    }


def _seen(
    blade: Blade,
    steady: SteadyBlade,
    at: FloatArray,
    q: FloatArray,
    q_dot: FloatArray,
    q_ddot: FloatArray,
    by: Driven | None = None,
) -> FloatArray:
    """Return the change of the outputs, (points, 12), by changes of the coordinates.

    With `by` under one load more, whose own share is taken whole.
    """
    size = max(float(np.linalg.norm(q)), math.ulp(1.0))
    step = _STEP / size
    model, unit = steady.model, blade.bending_stiffness / blade.length
    ends = []
    for sign in (step, -step):
        there = steady.equilibrium + sign * q
        (place,), (section,) = model.standing(there[None], at)
        force, moment = steady.section_loads(
            at, there[None], sign * q_dot[None], sign * q_ddot[None]
        )
        ends.append((place, section, force[0], moment[0]))
    place, section, force, moment = (
        (one - other) / (2.0 * step) for one, other in zip(*ends, strict=True)
    )
    if by is not None:
        still, here = np.zeros((1, q.size)), steady.equilibrium[None]
        for sign, driven in ((1.0, by), (-1.0, steady.by())):
            more = model.section_loads(at, here, still, still, driven)
            force, moment = force + sign * more[0][0], moment + sign * more[1][0]
    (_,), (now,) = model.standing(steady.equilibrium[None], at)
    spin = section @ np.swapaxes(now, 1, 2)
    turn = 0.5 * np.stack(
        [
            spin[:, 2, 1] - spin[:, 1, 2],
            spin[:, 0, 2] - spin[:, 2, 0],
            spin[:, 1, 0] - spin[:, 0, 1],
        ],
        axis=-1,
    )
    return np.concatenate(
        (blade.length * place, turn, unit / blade.length * force, unit * moment), axis=1
    )
