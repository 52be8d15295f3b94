"""Yoo and Shin's model of lag and stretch: linear about the blade that rotation has not stretched.

With the stretch s along the blade, the deflection v, the tension N = w̄²∫ₓ¹ (δ + ξ) dm of the
unstretched blade and c = cos ψ,

    m(s̈ - 2cw̄ v̇ - w̄² s) = (EA s')'/μ,      m(v̈ + 2cw̄ ṡ - c²w̄² v) = (N v')' - (EI v'')''.

The Coriolis force couples both, which takes the frequencies most of the way from the inextensible
blade's to the true ones. The rest is the stretch e of the steady state. Linearized about it, as in
`linear_modes`, the tension acts from the stretched position of the mass. The tangent turns by
v'/(1+e) rather than v': N/(1+e) and the curvature (v'/(1+e))' replace N and v''. So these are the
exact equations, linearized about e = 0.
"""

from __future__ import annotations

from ...arrays import FloatArray
from ...beam import AnyBlade, warn_if_rpm
from ...input_checks import rotation_speed, whole_number
from ...theory import BERNOULLI_EULER
from ...threads import one_thread
from ..beam.discretization import resolved_model
from .modes import settled_modes

_FEWEST = 20  # functions


@one_thread
def unstretched_frequencies(beam: AnyBlade, omega: float, count: int = 3) -> FloatArray:
    """Return natural frequencies [rad/s] as published of the unstretched beam, ascending (count,).

    The chordwise tables of Yoo and Shin (1998) and of Chung and Yoo (2002) linearize about the
    beam that rotation has not stretched. At their slenderness √(AL²/I) = 70 that is 0.03 % too
    high at w̄ = 2 and 0.4 % at w̄ = 10; `linear_modes` has the true frequencies. Axial ones are
    among them.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of frequencies, at most 128.

    Raises
    ------
    ValueError
        If `omega` is negative, not finite, or tears the beam; if `count` is too large, or 256
        functions do not settle the frequencies.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from analytic.exact.linear.unstretched import unstretched_frequencies
    >>> beam = Beam.reference()
    >>> print(unstretched_frequencies(beam, omega=6.0).round(5))
    [ 3.73048 23.01044 56.64848]
    >>> print(linear_modes(beam, omega=6.0).frequencies.round(5))
    [ 3.7304  23.01006 56.64712]
    """
    omega = rotation_speed(omega)
    count = whole_number("count", count)
    warn_if_rpm(beam, omega)
    model = resolved_model(beam, count, BERNOULLI_EULER, max(_FEWEST, 2 * count))
    _, modes = settled_modes(beam, omega, count, model, stretched=False)
    return modes.frequencies[:count] * beam.frequency_scale
