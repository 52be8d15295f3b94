"""Damping ratios: how fast the modes of a damped blade in rotation decay."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...input_checks import rotation_speed, whole_number
from ...methods.gyroscopic import inverse_eigenvalues
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..beam.discretization import MOST_FUNCTIONS
from ..beam.steady import steady_rotation
from ..space.steady import lives_in_space, space_rotation
from .modes import linear_modes

_FUNCTIONS = 20
_SAME = 0.3  # how far |λ| may be from the undamped frequency, relative to it


@one_thread
def damping_ratios(
    beam: AnyBlade, omega: float, count: int = 3, *, theory: Theory = BERNOULLI_EULER
) -> FloatArray:
    """Return the damping ratios ζ of the modes of `linear_modes`, (count,).

    ζ = -Re λ/|λ| of the eigenvalues λ of small vibration about the stretched state; free vibration
    of mode j decays as exp(-ζ_j |λ_j| t), with |λ_j| near the frequency of `linear_modes`.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of modes.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.

    Raises
    ------
    ValueError
        If an input is refused, or a mode is damped so much that it does not oscillate.

    Examples
    --------
    >>> from analytic import Beam, Damping, damping_ratios
    >>> blade = Beam.reference().with_damping(Damping(bending=1e-3, external=0.01))
    >>> for omega in (0.0, 6.0):
    ...     print(damping_ratios(blade, omega).round(5))
    [0.00996 0.01047 0.02601]
    [0.00791 0.00831 0.02347]
    """
    omega, count = rotation_speed(omega), whole_number("count", count, most=MOST_FUNCTIONS // 2)
    modes = linear_modes(beam, omega, count, theory=theory, functions=max(_FUNCTIONS, 2 * count))
    rotation: Any = space_rotation if lives_in_space(beam) else steady_rotation
    steady = rotation(beam, omega, modes.model)
    at_rest = np.zeros((1, steady.size))
    tangent = steady.tangent(steady.equilibrium[None], at_rest, at_rest)
    inverse = inverse_eigenvalues(tangent.mass[0], tangent.damping[0], tangent.stiffness[0])
    inverse = inverse[inverse.imag < 0.0]
    size = 1.0 / (np.abs(inverse) * modes.frequencies[:, None] / beam.frequency_scale)
    nearest = np.argmin(np.abs(size - 1.0), axis=1)
    for mode, found in enumerate(nearest):
        if abs(size[mode, found] - 1.0) > _SAME or found in nearest[:mode]:
            raise ValueError(
                f"mode {mode + 1} is damped so much that it does not oscillate: ask for count="
                f"{mode} or less, or take less damping"
            )
    # -Re λ/|λ| is -Re(1/λ)/|1/λ|.
    return np.asarray(-inverse[nearest].real / np.abs(inverse[nearest]))
