"""TEMPORARY stand-in."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from analytic import periodic_orbits, spin_up_response


@dataclass(frozen=True, kw_only=True, eq=False)
class Reference:
    case: object
    theory: object
    bound: float = 1e-7
    source: str = "computed"

    @cached_property
    def _spline(self):
        t = np.arange(0, self.case.duration + 0.005, 0.01)
        r = spin_up_response(self.case.blade, self.case.motion, t, tolerance=1e-6)
        return CubicHermiteSpline(t, r.q, r.q_dot)

    def history(self, times):
        if self.case.amplitudes:
            from .cases import starting_orbit

            o = starting_orbit(self.case)
            return self.case.blade.length * o.response(times, 0)
        return self._spline(times)

    def first_frequency(self, speed):
        return self.theory.first_frequency(self.case.blade, speed)

    def frequency_at(self, a, speed=None):
        return float(
            periodic_orbits(
                self.case.blade, self.case.motion.omega if speed is None else speed, [a]
            ).frequency[0]
        )


@lru_cache
def reference(case, theory=None):
    from .theory import BERNOULLI_EULER

    theory = theory or BERNOULLI_EULER
    return Reference(case=case, theory=theory)
