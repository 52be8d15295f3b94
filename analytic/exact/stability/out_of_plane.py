"""Small motion out of the plane about a planar motion of the blade: its second-order Lagrangian.

With the deflection w, β = w'/(1 + e) the angle of the tangent to the plane, φ the twist of the
section about the tangent, κ = ϑ' and N the planar motion's curvature and axial force, in units of
the root's EI, m and L, and ratios r and g of the `OutOfPlane` section,

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

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from ...arrays import FloatArray, evaluated
from ...blade import Blade
from ...blade_checks import require_out_of_plane
from ...lazily import linalg
from ...methods.orbit import Orbit
from ...methods.system import Tangent
from ...shape_functions import ShapeFunctions, shape_functions
from ...theory import BERNOULLI_EULER, Theory
from ..continuum.planar import Continuum
from ..continuum.rotation import SteadyBlade


@lru_cache(maxsize=32)
def _bases(shapes: ShapeFunctions, model: Continuum) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return w'' and w' (φ' and φ) of the functions at the model's points, and its integrals."""
    return shapes.strain(model.points), shapes.once(model.points), model.integrals_at_points


class FlapTorsion:
    """Galerkin discretization of L2 by at least so many shape functions for w and for φ each.

    The theory tells whether there are the second line of L2, and inertia of the twist, as in space.
    The coordinates of w come first.
    """

    def __init__(self, blade: Blade, functions: int, theory: Theory = BERNOULLI_EULER) -> None:
        section = require_out_of_plane(blade)
        self.blade, self.unit, self.section, self.theory = blade, blade.unit, section, theory
        self.shapes = shape_functions(self.unit, functions)
        self.functions = self.shapes.count
        self.g = np.inf if section.torsion_ratio is None else section.torsion_ratio
        # At r = 1 the twist follows κβ at no cost, whatever g. Its inertia would split the double
        # multiplier 1 at rest, for the spin about the tangent is not φ̇ alone.
        self.twists = bool(np.isfinite(self.g)) and section.bending_ratio != 1.0
        told = blade.section.rotary_inertia
        self._told = told is not None
        # Whether slices turn in bending too, or feel the clamp's rotation, or neither.
        self._whole = self._told or theory.rotary_inertia
        self._carried = theory.trapeze and not self._whole
        self.size = (1 + self.twists) * self.functions

    @cached_property
    def mass(self) -> FloatArray:
        """The constant mass matrix (n, n)."""
        at, dm = self.unit.inertia(self.shapes.a_panel + 3)
        w = self.shapes.twice(at)
        across = w.T @ (dm[:, None] * w)
        if not self.twists:
            return across
        x, dx = self.unit.quadrature(self.shapes.a_panel + 8)
        phi = self.shapes.once(x)
        return linalg.block_diag(across, phi.T @ ((dx * self._polar(x))[:, None] * phi))

    def _held(self, x: FloatArray, tension: FloatArray) -> FloatArray:
        """Return GJ + Nk² at `x`."""
        r, unit = self.section.bending_ratio, self.unit
        torsion = self.g * evaluated(unit.bending, x)
        gyration = evaluated(unit.bending, x) / evaluated(unit.axial, x)
        if self.theory.trapeze:
            torsion = torsion + tension * self.blade.slenderness * (1.0 + r) * gyration
        return np.broadcast_to(torsion, tension.shape)

    def _turned(
        self, x: FloatArray, rate: FloatArray, spin: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return ιs² and j2w̄² at `x` of slices that turn in the plane by the rate `spin`."""
        polar, r = self._polar(x) / (1.0 + self.section.bending_ratio), self.section.bending_ratio
        carried = self._carried * np.square(rate) * polar
        held = carried + self._whole * np.square(spin) * polar
        return (1.0 - r) * held, r * carried

    def _polar(self, x: FloatArray) -> FloatArray:
        """Return j at `x`, over m0 L²."""
        unit, both = self.unit, 1.0 + self.section.bending_ratio
        if self._told:
            return both * evaluated(unit.rotary, x)
        own = evaluated(unit.mass, x) * evaluated(unit.bending, x) / evaluated(unit.axial, x)
        return self.blade.slenderness * both * own

    def stiffness(
        self, planar: Any, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, *drive: Any
    ) -> FloatArray:
        """Return the stiffness (samples, n, n) about a motion of `planar` under its drive."""
        model, r = planar.model, self.section.bending_ratio
        x, (strain, once, upto) = model.points, _bases(self.shapes, model)
        kappa, e, change = model.bent(q)
        by = planar.by(*drive)
        tension = model.tension(q, q_dot, q_ddot, by)
        bending, kappa_dot = model.weights * evaluated(self.unit.bending, x), model.bent(q_dot)[0]
        moment = bending * (kappa + model.blade.damping[0] * kappa_dot)
        excess = moment - r * bending * kappa
        stretch = 1.0 / (1.0 + e)
        angle = stretch[..., None] * once
        bent = stretch[..., None] * strain - (change * stretch**2)[..., None] * once
        straight = _form(angle, model.weights * tension / stretch - moment * kappa, angle)
        straight += _form(bent, r * bending, bent)
        rate = np.asarray(by.rate)[..., None]
        turning, tilting = self._turned(x, rate, rate + kappa_dot @ upto.T)
        straight -= _form(angle, model.weights * tilting, angle)
        if not self.twists:
            twist = -np.einsum("xy,sy,syk->sxk", upto, kappa, angle, optimize=True)
            mixed = _form(bent, excess, twist)
            twisted = _form(twist, model.weights * turning - excess * kappa, twist)
            return straight + mixed + np.swapaxes(mixed, 1, 2) + twisted
        torsion = model.weights * self._held(x, tension)
        straight += _form(angle, torsion * kappa**2, angle)
        mixed = _form(angle, torsion * kappa, strain)
        mixed += _form(bent, excess, once)
        twisted = _form(strain, torsion, strain)
        twisted += _form(once, model.weights * turning - excess * kappa, once)
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
        model, r, (viscosity, _, air) = planar.model, self.section.bending_ratio, self.unit.damping
        x, (strain, once, upto) = model.points, _bases(self.shapes, model)
        (kappa, e, change), (kappa_dot, e_dot, change_dot) = model.bent(q), model.bent(q_dot)
        s = 1.0 / (1.0 + e)
        s_dot = -e_dot * s**2
        angle, angle_dot = _times(s, once), _times(s_dot, once)
        flap = _times(s, strain) - _times(change * s**2, once)
        flap_dot = _times(s_dot, strain)
        flap_dot -= _times(change_dot * s**2 + 2.0 * change * s * s_dot, once)
        curved = _times(kappa, angle)
        curved_dot = _times(kappa_dot, angle) + _times(kappa, angle_dot)
        viscous = viscosity * model.weights * evaluated(self.unit.bending, x)
        if self.twists:
            flap = np.concatenate((flap, -_times(kappa, once)), axis=2)
            flap_dot = np.concatenate((flap_dot, -_times(kappa_dot, once)), axis=2)
            along = np.broadcast_to(strain, curved.shape)
            torsion = np.concatenate((curved, along), axis=2)
            torsion_dot = np.concatenate((curved_dot, 0.0 * along), axis=2)
            damping = _form(torsion, self.g * viscous, torsion)
            stiffness = _form(torsion, self.g * viscous, torsion_dot)
        else:
            twist, twist_dot = -upto @ curved, -upto @ curved_dot
            flap_dot = flap_dot - _times(kappa_dot, twist) - _times(kappa, twist_dot)
            flap = flap - _times(kappa, twist)
            damping, stiffness = np.zeros((2, len(q), self.size, self.size))
        w = self.shapes.twice(x)
        damping[:, : self.functions, : self.functions] += air * _form(w, model.weights, w)
        damping += _form(flap, r * viscous, flap)
        return damping, stiffness + _form(flap, r * viscous, flap_dot)


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
        if any(across.unit.damping):
            own, more = across.resistance(planar, *state[:2])
            K, C = K + more, C + own
        return Tangent(np.zeros(K.shape[:2]), K, C, np.broadcast_to(across.mass, K.shape))

    @property
    def reversible(self) -> bool:
        """Whether the orbit is free and nothing damps what leaves its plane."""
        driven = self.orbit.system.driven
        return self.modal is None and not driven and not any(self.across.unit.damping)

    @property
    def signs(self) -> FloatArray:
        """Signs of the coordinates under time reversal: the twist turns with the curvature."""
        return np.where(np.arange(self.across.size) < self.across.functions, 1.0, -1.0)

    def constants(self) -> None:
        """Return None: nothing is known beforehand of its multipliers."""
