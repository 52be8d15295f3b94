"""A blade out of its plane at the start: a small kick, from which whatever grows can grow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic import AnyBlade, linear_modes
from analytic.arrays import FloatArray
from analytic.beam import require_planar
from analytic.exact.beam.state import BeamState, straight_state
from analytic.exact.space.steady import require_bent
from analytic.lazily import integrate, interpolate

_ALONG, _BETWEEN = 401, 8
"""Points of a mode's spline, and pieces of an element over which the kick is integrated."""


def kicked(
    blade: AnyBlade,
    kick: float = 1e-6,
    planar: Callable[[FloatArray], BeamState] | None = None,
    *,
    by_mode: bool = False,
) -> Callable[[FloatArray], BeamState]:
    """Return the `initial_state` for `simulate` of a blade that is bent out of its plane.

    By an arc, w = kick L (x/L)² of small ones, at rest: its tangents are turned out of the plane by
    2 kick x/L. An arc is no mode: it has a share of each, so that whatever grows has something to
    grow from. It bends and does not stretch, which of a slender blade would take all its energy.

    Parameters
    ----------
    blade : Beam or Blade
    kick : float
        Deflection of the tip out of the plane over L.
    planar : callable, optional
        Planar state onto which the kick is put, as ``lambda x: backbone.state(i, x)``; the
        straight blade at rest by default.
    by_mode : bool
        Bend it by the first flap mode at rest, as `spin_up_response(bent=)` does. No other wave is
        excited, but elements that shear need small steps if the blade is very slender.

    Raises
    ------
    ValueError
        If the kick is more than a tenth of the length.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, Tube
    >>> from rotbeam_exu import kicked, simulate
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> tube = Beam.reference().with_shape(Tube())
    >>> settings = {"element": "space_exact", "elements": 4, "duration": 1.5, "step": 5e-3}
    >>> run = simulate(tube, motion, initial_state=kicked(tube, 1e-3), **settings)
    >>> print(f"q {run.q.min().item():.3f} m, w at most {abs(run.w).max().item():.4f} m")
    q -4.652 m, w at most 0.0080 m
    """
    require_planar(blade)
    require_bent("kick", kick)
    slope: Callable[[FloatArray], FloatArray] = lambda x: 2.0 * x / blade.length  # noqa: E731
    if by_mode:
        along = np.linspace(0.0, blade.length, _ALONG)
        mode = linear_modes(blade, 0.0, 1, plane="flap").shapes(along)[:, 0]
        slope = interpolate.CubicSpline(along, blade.length * mode).derivative()

    def state(x: FloatArray) -> BeamState:
        fine = np.linspace(0.0, blade.length, _BETWEEN * (x.size - 1) + 1)
        start, tilt = (planar or straight_state)(fine), kick * slope(fine)
        # The change of the slopes (u', v', w') turns the tangent, and keeps its length.
        tangent = np.stack((1.0 + start.u_slope, start.v_slope))
        slopes = np.vstack((tangent * (np.cos(tilt) - 1.0), np.hypot(*tangent) * np.sin(tilt)))
        u, v, w = integrate.cumulative_simpson(slopes, x=fine, initial=0.0)
        bent = replace(
            start, u=start.u + u, v=start.v + v, w=w, u_slope=start.u_slope + slopes[0],
            v_slope=start.v_slope + slopes[1], w_slope=slopes[2],
        )  # fmt: skip
        whole = {name: np.broadcast_to(a, fine.shape) for name, a in vars(bent).items()}
        return BeamState(**{name: a[::_BETWEEN] for name, a in whole.items()})

    return state
