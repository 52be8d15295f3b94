"""Small motion out of the plane about a planar motion of the blade: its second-order Lagrangian.

With the deflection w, β = w'/(1 + e) the angle of the tangent to the plane, φ the twist of the
section about the tangent, κ = ϑ' and N the planar motion's curvature and axial force, in units of
the root's EI, m and L, and r = EI2/EI and g = GJ/EI of the slices, which may vary along the blade,

    L2 = ½∫ẇ² dm + ½∫j φ̇² dx - ½∫(1 + e) N β² dx
         - ½∫[Nk²(φ' + κβ)² + ιs²φ² - j2w̄²β²] dx
         - ½∫EI [g(φ' + κβ)² + r(β' - κφ)² + 2κβ'φ - κ²(β² + φ²)] dx.

The second line is the trapeze effect, k² = (1 + r)EI/EA, and the propeller moment,
ι = j3 - j2 = j(1 - r)/(1 + r). Slices without rotary inertia of bending feel the clamp's rotation
alone, s = w̄, with j2 against flap; those with it turn by s = ϑ̇ + w̄, and theirs against flap is
left out. w has no Coriolis force: about a periodic orbit it is a Hill equation. Also left out is
what ϑ̇β adds to φ̇, of the order j, and the inertia against twist at r = 1 or where torsion is rigid.
The viscosity η_b of the blade resists the rates of β' - κφ and φ' + κβ. Of a damped planar motion
EIη_b κ̇ adds to the moment EIκ, which the stiffness out of the plane takes back by its share r of
EIκ alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray, evaluated
from ...blade import Blade
from ...blade_checks import require_out_of_plane
from ...lazily import linalg
from ...methods.orbit import Orbit
from ...methods.system import Tangent
from ...shape_functions import shape_functions
from ...theory import BERNOULLI_EULER, Theory
from ..continuum.planar import Continuum
from ..continuum.rotation import SteadyBlade
from ..continuum.unit import space_unit, trapeze_of


class _Slices(NamedTuple):
    """Data of slices at points, each (points,), over the root's EI, m0 and L."""

    flap: FloatArray  # EI2
    torsion: FloatArray  # GJ; infinite where none is needed
    gyration: FloatArray  # k² = (EI2 + EI3)/EA
    j1: FloatArray  # against torsion
    j2: FloatArray  # against flap
    j3: FloatArray


class _Bases(NamedTuple):
    """Functions at a model's points, (points, functions), and the integrals up to each."""

    w_bent: FloatArray  # w''
    w_slope: FloatArray  # w'
    twist_rate: FloatArray  # φ'
    twist: FloatArray  # φ
    upto: FloatArray


class FlapTorsion:
    """Galerkin discretization of L2 by at least so many shape functions for w and for φ each.

    The theory decides on the second line of L2 and on inertia of the twist, as in space.
    The coordinates of w come first.
    """

    def __init__(self, blade: Blade, functions: int, theory: Theory = BERNOULLI_EULER) -> None:
        blade = require_out_of_plane(blade)
        self.blade, self.unit, self.theory = blade, space_unit(blade), theory
        # Those of the blade's plane, where the stiffness varies as in it.
        self.shapes, self.twisting = (
            shape_functions(replace(blade.unit, bending=profile), functions)
            for profile in (self.unit.flapping, self.unit.twisting)
        )
        self.functions = self.shapes.count
        # At r = 1 the twist follows κβ at no cost, whatever g. Its inertia would split the double
        # multiplier 1 at rest, for the spin about the tangent is not φ̇ alone.
        self.twists = self.unit.twists and not self.unit.bends_alike
        # Whether slices turn in bending too, or feel the clamp's rotation, or neither.
        self._whole = self.unit.turns or theory.rotary_inertia
        self._carried = bool(theory.trapeze) and not self._whole
        self.size = (1 + self.twists) * self.functions
        self._on = lru_cache(maxsize=8)(self._on_points)

    def _slices(self, x: FloatArray) -> _Slices:
        """Return the slices at `x`."""
        mu = self.blade.slenderness
        soft, J = self.unit.flexibility(x, BERNOULLI_EULER, mu), self.unit.inertia_about(x, mu)[1]
        with np.errstate(divide="ignore"):
            torsion = 1.0 / soft[:, 3, 3]
        return _Slices(1.0 / soft[:, 4, 4], torsion, trapeze_of(soft), J[0, 0], J[1, 1], J[2, 2])

    def _on_points(self, model: Continuum) -> tuple[_Slices, _Bases]:
        """Return slices and functions at a model's points, and its integrals."""
        x, parts = model.points, (self.shapes, self.twisting)
        w, phi = ((of.strain(x), of.once(x)) for of in parts)
        return self._slices(x), _Bases(*w, *phi, model.integrals_at_points)

    @cached_property
    def mass(self) -> FloatArray:
        """The constant mass matrix (n, n)."""
        at, dm = self.unit.inertia(self.shapes.a_panel + 3)
        w = self.shapes.twice(at)
        across = w.T @ (dm[:, None] * w)
        if not self.twists:
            return across
        x, dx = self.unit.quadrature(self.shapes.a_panel + 8)
        phi = self.twisting.once(x)
        return linalg.block_diag(across, phi.T @ ((dx * self._slices(x).j1)[:, None] * phi))

    def stiffness(
        self, planar: Any, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, *drive: Any
    ) -> FloatArray:
        """Return the stiffness (samples, n, n) about a motion of `planar` under its drive."""
        model, by = planar.model, planar.by(*drive)
        of, (strain, once, strain_t, once_t, upto) = self._on(model)
        kappa, e, change = model.bent(q)
        tension = model.tension(q, q_dot, q_ddot, by)
        bending, kappa_dot = evaluated(self.unit.bending, model.points), model.bent(q_dot)[0]
        moment = model.weights * bending * (kappa + model.blade.damping.bending * kappa_dot)
        flap = model.weights * of.flap
        excess = moment - flap * kappa
        stretch = 1.0 / (1.0 + e)
        angle = stretch[..., None] * once
        bent = stretch[..., None] * strain - (change * stretch**2)[..., None] * once
        straight = _form(angle, model.weights * tension / stretch - moment * kappa, angle)
        straight += _form(bent, flap, bent)
        rate = np.asarray(by.rate)[..., None]
        # ιs², and j2w̄² of slices that feel the clamp's rotation alone.
        carried, spin = self._carried * np.square(rate), rate + kappa_dot @ upto.T
        turning = (of.j3 - of.j2) * (carried + self._whole * np.square(spin))
        straight -= _form(angle, model.weights * carried * of.j2, angle)
        if not self.twists:
            twist = -np.einsum("xy,sy,syk->sxk", upto, kappa, angle, optimize=True)
            mixed = _form(bent, excess, twist)
            twisted = _form(twist, model.weights * turning - excess * kappa, twist)
            return straight + mixed + np.swapaxes(mixed, 1, 2) + twisted
        torsion = model.weights * (of.torsion + bool(self.theory.trapeze) * tension * of.gyration)
        straight += _form(angle, torsion * kappa**2, angle)
        mixed = _form(angle, torsion * kappa, strain_t)
        mixed += _form(bent, excess, once_t)
        twisted = _form(strain_t, torsion, strain_t)
        twisted += _form(once_t, model.weights * turning - excess * kappa, once_t)
        return np.concatenate(
            (
                np.concatenate((straight, mixed), axis=2),
                np.concatenate((np.swapaxes(mixed, 1, 2), twisted), axis=2),
            ),
            axis=1,
        )

    def resistance(
        self, planar: SteadyBlade, q: FloatArray, q_dot: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the blade's own damping, and the stiffness that it adds, (samples, n, n) each."""
        model, damped = planar.model, self.unit.damping
        *_, twisting, across, _ = damped.of_strains
        of, (strain, once, strain_t, once_t, upto) = self._on(model)
        (kappa, e, change), (kappa_dot, e_dot, change_dot) = model.bent(q), model.bent(q_dot)
        s = 1.0 / (1.0 + e)
        s_dot = -e_dot * s**2
        angle, angle_dot = _times(s, once), _times(s_dot, once)
        flap = _times(s, strain) - _times(change * s**2, once)
        flap_dot = _times(s_dot, strain)
        flap_dot -= _times(change_dot * s**2 + 2.0 * change * s * s_dot, once)
        curved = _times(kappa, angle)
        curved_dot = _times(kappa_dot, angle) + _times(kappa, angle_dot)
        if self.twists:
            flap = np.concatenate((flap, -_times(kappa, once_t)), axis=2)
            flap_dot = np.concatenate((flap_dot, -_times(kappa_dot, once_t)), axis=2)
            along = np.broadcast_to(strain_t, curved.shape)
            torsion = np.concatenate((curved, along), axis=2)
            torsion_dot = np.concatenate((curved_dot, 0.0 * along), axis=2)
            viscous = twisting * model.weights * of.torsion
            damping = _form(torsion, viscous, torsion)
            stiffness = _form(torsion, viscous, torsion_dot)
        else:
            twist, twist_dot = -upto @ curved, -upto @ curved_dot
            flap_dot = flap_dot - _times(kappa_dot, twist) - _times(kappa, twist_dot)
            flap = flap - _times(kappa, twist)
            damping, stiffness = np.zeros((2, len(q), self.size, self.size))
        w = self.shapes.twice(model.points)
        dragged = damped.external * _form(w, model.weights, w)
        damping[:, : self.functions, : self.functions] += dragged
        viscous = across * model.weights * of.flap
        damping += _form(flap, viscous, flap)
        return damping, stiffness + _form(flap, viscous, flap_dot)


def with_points_for(planar: Any, functions: int) -> Any:
    """Return the planar system on a basis whose points integrate so many functions."""
    while planar.model.points.size < 2 * functions + 8 * planar.model.blade.panel_count:
        planar = planar.refined()
    return planar


def _form(left: FloatArray, weights: FloatArray, right: FloatArray) -> FloatArray:
    """Return ∫ left weights right, (samples, functions, functions)."""
    return np.asarray(np.swapaxes(left, -1, -2) @ (weights[..., None] * right))


def _times(factor: FloatArray, functions: FloatArray) -> FloatArray:
    """Return the functions times a factor at the points (samples, points)."""
    return np.asarray(factor[..., None] * functions)


@dataclass(frozen=True)
class OutOfPlaneMotion:
    """Small motion out of the plane about a periodic orbit, as `methods.floquet` sees an orbit.

    It may have `modal` damping (n, n) on top of the blade's own.
    """

    orbit: Orbit[Any]
    across: FlapTorsion
    modal: FloatArray | None = None

    @property
    def frequency(self) -> float:
        """Ω of the planar orbit."""
        return self.orbit.frequency

    def tangent(self, phase: FloatArray) -> Tangent:
        """Return the coefficients of the Hill equation at the phases (phases,)."""
        across, planar, state = self.across, self.orbit.system, self.orbit.coordinates(phase)
        K = across.stiffness(planar, *state, *self.orbit.drive(phase))
        C = np.zeros_like(K) if self.modal is None else np.broadcast_to(self.modal, K.shape)
        if across.unit.damping:
            damping, stiffening = across.resistance(planar, *state[:2])
            K, C = K + stiffening, C + damping
        return Tangent(np.zeros(K.shape[:2]), K, C, np.broadcast_to(across.mass, K.shape))

    @property
    def reversible(self) -> bool:
        """Whether the orbit is free and nothing damps what leaves its plane."""
        driven = self.orbit.system.driven
        return self.modal is None and not driven and not self.across.unit.damping

    @property
    def signs(self) -> FloatArray:
        """Signs of the coordinates under time reversal: the twist turns with the curvature."""
        return np.where(np.arange(self.across.size) < self.across.functions, 1.0, -1.0)

    def constants(self) -> None:
        """Return None: nothing is known beforehand of its multipliers."""
