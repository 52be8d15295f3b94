"""Where a harmonic of an orbit meets another mode: internal resonance."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..input_checks import RotbeamWarning
from .steady import BeamOrbit

_NEAR = 0.02  # an internal resonance is this near, relative to the other mode's frequency
_NOTICEABLE = 1e-6  # size of a harmonic, relative to the first, that can drive another mode


def nearest_resonance(orbit: BeamOrbit, modes: FloatArray, mode: int) -> str:
    """Return which harmonic is nearest to another mode: the usual reason why a branch bends."""
    multiples = np.arange(2, orbit.harmonics + 1) * orbit.frequency
    distance = np.abs(multiples[:, None] / modes - 1.0)
    distance[:, mode - 1] = np.inf
    k, j = np.unravel_index(np.argmin(distance), distance.shape)
    return f" (harmonic {k + 2} is {100.0 * distance[k, j]:.1f} % from mode {j + 1} there)"


def warn_of_resonances(
    orbits: Sequence[BeamOrbit], modes: FloatArray, mode: int, per_second: float
) -> None:
    """Warn once for each pair of a harmonic and another mode that come within 2 %."""
    warned: set[tuple[int, int]] = set()
    for orbit in orbits:
        sizes = np.linalg.norm(orbit.sines, axis=1) / np.linalg.norm(orbit.sines[0])
        for k in (1 + np.flatnonzero(sizes > _NOTICEABLE)).tolist():
            frequency = k * orbit.frequency
            near = np.abs(frequency / modes - 1.0) < _NEAR
            for j in (1 + np.flatnonzero(near)).tolist():
                if j == mode or (k, j) in warned:
                    continue
                warned.add((k, j))
                warnings.warn(
                    f"internal resonance: from a = {orbit.amplitude:g} on, harmonic {k} of the "
                    f"orbit of mode {mode} ({frequency * per_second:.4f} rad/s) is within 2 % of "
                    f"mode {j} ({modes[j - 1] * per_second:.4f} rad/s); the backbone may branch "
                    "there",
                    RotbeamWarning,
                    stacklevel=3,
                )
