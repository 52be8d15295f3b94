"""Derivatives of free orbits and of forced responses to the numbers of a blade.

A free orbit is the root of F(z, p) = 0: the harmonics of the residual, and the peak less the
amplitude; z are the coefficients and the frequency Ω. So dΩ/dp = -λ·∂F/∂p, where λ is the row of
the inverse tangent that belongs to Ω: one solution for all parameters. Of a forced response the
frequency is given, and the peak answers: da/dp = ∂a/∂p - λ·∂F/∂p, with λ of the peak's gradient.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.loading import unit_load
from ..exact.continuum.rotation import BladeOrbit, SteadyBlade
from ..exact.driven.forced import forced_response
from ..exact.driven.forced_orbits import ForcedResponse
from ..exact.free.backbone import periodic_orbits
from ..exact.free.orbits import Orbits
from ..load import Load
from ..methods.fourier import waves
from ..methods.harmonic_balance import jacobian, projected
from ..motion import SteadyRotation
from .conditions import case_of, conditions_of
from .energies import OneByOne, difference
from .frequencies import FrequencyDerivatives, in_space, modes_until
from .frozen import model_of
from .parameters import Parameter, parameters_of

_CHANGE = 1e-4  # of a parameter over its size


class OrbitDerivatives(OneByOne):
    """Derivatives of frequencies, and of softening (1 - ω_NL/ω_n)/a², at the orbits' amplitudes."""

    def __init__(self, orbits: Orbits) -> None:
        several = [f"{a:g}" for a in orbits.amplitude.tolist()]
        self.outputs = tuple(
            f"{what} at a = {a}" for what in ("frequency", "softening") for a in several
        )
        self.units = ("rad/s",) * len(several) + ("1",) * len(several)
        self._over, self._squares = orbits.frequency / orbits.omega_n, orbits.amplitude**2
        self.values = _frequencies(orbits)
        self._orbits = orbits
        self.parameters = parameters_of(orbits.blade, orbits.theory)
        self.given = SteadyRotation(omega=orbits.omega), ()
        self.conditions = conditions_of(*self.given, orbits.blade.frequency_scale)
        self._linear = _linear(orbits)
        self._rows = [_adjoint(orbit) for orbit in orbits.nondimensional]

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all outputs to a parameter."""
        slopes = [
            -difference(parameter, partial(self._defect, k), _CHANGE)
            for k in range(len(self._rows))
        ]
        frequency = self._orbits.blade.frequency_scale * np.array(slopes)
        linear = self._linear
        own = (linear.parameters | linear.conditions)[parameter.name]
        (of_linear,) = linear.to(own) / linear.values
        change = frequency / self._orbits.frequency - of_linear
        return np.concatenate((frequency, -self._over * change / self._squares))

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the numbers of another blade's orbits, at another speed, by name."""
        del loads
        of = self._orbits
        other = periodic_orbits(blade, motion.omega, of.amplitude, mode=of.mode, theory=of.theory)
        return dict(zip(self.outputs, _frequencies(other).tolist(), strict=True))

    def _defect(self, k: int, other: Any) -> FloatArray:
        """Return λ·F of an orbit in another blade, or at another speed."""
        orbit = self._orbits.nondimensional[k]
        system, units = _system(orbit.system, self._orbits, other)
        met = _met(orbit, system, self._orbits.blade.frequency_scale / units.frequency_scale)
        return np.asarray(np.append(*met) @ self._rows[k])


class ResponseDerivatives(OneByOne):
    """Derivatives of a forced response at the frequencies given, and of its maxima."""

    def __init__(self, response: ForcedResponse) -> None:
        at = _marked(response)
        self.outputs = tuple(f"peak at {response.frequency[k]:.6g} rad/s" for k in at)
        self.units, self.values = ("1",) * len(at), response.amplitude[at]
        self._response, self._orbits = response, [response.nondimensional[k] for k in at]
        self.parameters = parameters_of(response.blade, response.theory)
        self.given = SteadyRotation(omega=float(response.omega[0])), (response.load,)
        self.conditions = conditions_of(*self.given, response.blade.frequency_scale)
        if response.load.varied == "speed":
            del self.conditions["omega"]  # it is given at every point
        self._rows = [
            np.linalg.solve(jacobian(orbit)[:-1, :-1].T, orbit.peak_gradient()[:-1])
            for orbit in self._orbits
        ]

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all peaks to a parameter."""
        several = range(len(self._rows))
        return np.array([difference(parameter, partial(self._peak, k), _CHANGE) for k in several])

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the peaks of another blade, at another speed, under another load, by name.

        Where a maximum comes or goes, those at the frequencies given alone.
        """
        of, (load,) = self._response, loads
        given = of.frequency[_marked(of, "asked")]
        if load.varied == "speed":
            other = forced_response(blade, given, load, theory=of.theory)
        else:
            other = forced_response(blade, motion.omega, load, given, theory=of.theory)
        kinds = ("asked", "peak") if len(_marked(other)) == len(self.outputs) else ("asked",)
        names = np.array(self.outputs)[np.isin(_marked(of), _marked(of, *kinds))].tolist()
        return dict(zip(names, other.amplitude[_marked(other, *kinds)].tolist(), strict=True))

    def _peak(self, k: int, other: Any) -> FloatArray:
        """Return the peak less λ·F in another blade, at another speed, or under another load."""
        response, orbit = self._response, self._orbits[k]
        driven, units = _system(orbit.system, response, other)
        system: Any = driven
        *_, (load,) = case_of(other, response.blade, self.given)
        unit = response.blade.frequency_scale / units.frequency_scale
        harmonics, height = _met(orbit, replace(system, drive=unit_load(units, load)), unit)
        return np.asarray(height - harmonics @ self._rows[k])


def _marked(response: ForcedResponse, *kinds: str) -> list[int]:
    """Return the points at frequencies given and of maxima, or some of these kinds."""
    return [k for k, mark in enumerate(response.marks) if mark in (kinds or ("asked", "peak"))]


def _frequencies(orbits: Orbits) -> FloatArray:
    """Return frequencies and softening."""
    softening = (1.0 - orbits.frequency / orbits.omega_n) / orbits.amplitude**2
    return np.concatenate((orbits.frequency, softening))


def _met(orbit: BladeOrbit, system: SteadyBlade, unit: float) -> tuple[FloatArray, FloatArray]:
    """Return the harmonics of the residual of an orbit in another system, and its peak there."""
    other = replace(orbit, system=system, frequency=unit * orbit.frequency)
    phases, weights = orbit.crests
    q = waves(phases, orbit.harmonics, order=0)[0] @ orbit.coefficients
    if phases.size == 1:
        weights = np.sign(orbit.system.gauge(q))
    return projected(other), weights @ system.gauge(q)


def _adjoint(orbit: BladeOrbit) -> FloatArray:
    """Return the row of the inverse tangent that belongs to the frequency."""
    matrix = jacobian(orbit)
    matrix[-1] = orbit.peak_gradient()
    return np.asarray(np.linalg.solve(matrix.T, np.eye(len(matrix))[-1]))


def _system(
    system: SteadyBlade, of: Orbits | ForcedResponse, other: Any
) -> tuple[SteadyBlade, Blade]:
    """Return the same equations of another blade or motion, and the blade of their units."""
    blade, model, rate = of.blade, system.model, system.rate
    if isinstance(other, Blade):
        model, blade = model_of(model, blade, of.theory, other)
        rate *= of.blade.frequency_scale / blade.frequency_scale
    else:
        rate = other[0].omega / blade.frequency_scale
    return replace(system, model=model, rate=rate, near=system.equilibrium, given=None), blade


def _linear(orbits: Orbits) -> FrequencyDerivatives:
    """Return the derivatives of the linear mode that the orbits grow out of."""
    modes = modes_until(
        lambda modes: orbits.mode in modes.names, orbits.blade, orbits.omega, orbits.theory
    )
    return FrequencyDerivatives(in_space(modes).among([modes.names.index(orbits.mode)]))
