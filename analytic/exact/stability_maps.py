"""Maps over speed, amplitude and shape: how fast planar orbits leave their plane, and where."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import AnyBlade, require_blade
from ..input_checks import finite_values, rotation_speed
from ..methods.harmonic_balance import NoOrbitError
from ..out_of_plane import OutOfPlane
from ..threads import one_thread
from .growth import STEPS, grown, settled_functions
from .orbit_growth import planar_orbits
from .space import require_out_of_plane
from .stability_limit import LARGEST, stability_limit


@one_thread
def growth_map(
    blade: AnyBlade, omegas: ArrayLike, amplitudes: ArrayLike, mode: int = 1
) -> FloatArray:
    """Return the growth rates [1/s] out of the plane, (speeds, amplitudes), zero where stable.

    On as many functions and steps as `planar_stability` begins with; NaN where no orbit was found.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane.
    omegas, amplitudes : array_like
        Rotation speeds [rad/s] and peak tip deflections |q|/L.
    mode : int
        In-plane mode from which the orbits grow, from 1.

    Examples
    --------
    >>> from analytic import Beam, growth_map
    >>> print(growth_map(Beam.reference().rectangle(), [4.0], [0.02, 0.1]).round(2))
    [[ 0.   33.42]]
    """
    require_out_of_plane(blade)
    speeds = finite_values("omegas", omegas, "rad/s")
    peaks = finite_values("amplitudes", amplitudes)
    rates = np.full((speeds.size, peaks.size), np.nan)
    for row, omega in zip(rates, speeds.tolist(), strict=True):
        orbit = planar_orbits(blade, rotation_speed(omega, "omegas"), mode)
        for k, a in enumerate(peaks.tolist()):
            try:
                at = orbit(a)
            except NoOrbitError:
                break
            functions = settled_functions(blade, at.system)
            rate = at.frequency * blade.frequency_scale
            row[k] = grown(blade, at, functions, STEPS).rate(rate)
    return rates


@one_thread
def limit_map(
    blade: AnyBlade, ratios: ArrayLike, omegas: ArrayLike, mode: int = 1, largest: float = LARGEST
) -> FloatArray:
    """Return the limits of stability of rectangles, (ratios, speeds); infinite: none.

    The blade keeps its EA, EI and m: material and size follow the ratio.

    Parameters
    ----------
    blade : Beam or Blade
    ratios : array_like
        Height in the plane over width.
    omegas : array_like
        Rotation speeds [rad/s].
    mode, largest
        As for `stability_limit`.

    Examples
    --------
    >>> from analytic import Beam, limit_map
    >>> print(limit_map(Beam.reference(), ratios=[1.0], omegas=[4.0], largest=0.03))
    [[inf]]
    """
    require_blade(blade)
    shapes = [OutOfPlane.rectangle(ratio) for ratio in finite_values("ratios", ratios).tolist()]
    speeds = finite_values("omegas", omegas, "rad/s").tolist()
    return np.array(
        [
            [
                stability_limit(blade.with_out_of_plane(shape), w, mode, largest=largest).amplitude
                for w in speeds
            ]
            for shape in shapes
        ]
    )
