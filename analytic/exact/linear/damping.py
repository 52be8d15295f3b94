"""How fast the linear modes of the exact beam decay, and the damping that makes them decay so."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...arrays import FloatArray
from ...blade import Blade
from ...input_checks import positive, rotation_speed, shown, whole_number
from ...lazily import optimize
from ...methods.system import inverse_eigenvalues
from ...parts import Damping
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ...warning import warn
from ..continuum.planar import MOST_FUNCTIONS
from .modes import linear_modes, mode_name

_SAME = 0.3  # how far |λ| may be from the undamped frequency, relative to it
_SMALL = 1e-4
"""Ratios by which the effect of each coefficient is measured; the next order is their square."""
_COUNT = 12
"""Modes among which the named ones are looked for."""
_ROUNDS = 2
"""Fits, the second less what the first left, a third power of the ratios."""
_MET = 1e-3
"""Relative error of a ratio without a warning."""
_OF_FAMILY = {"flap": "out_of_plane", "lag": "bending", "torsion": "torsion", "axial": "axial"}


@one_thread
def damping_ratios(
    blade: Blade,
    omega: float,
    count: int = 3,
    *,
    theory: Theory = BERNOULLI_EULER,
    tolerance: float | None = None,
) -> FloatArray:
    """Return the damping ratios ζ of the modes of `linear_modes`, (count,).

    ζ = -Re λ/|λ| of the eigenvalues λ of small vibration about the stretched state; free vibration
    of mode j decays as exp(-ζ_j |λ_j| t), with |λ_j| near the frequency of `linear_modes`.

    Parameters
    ----------
    beam, omega, count, theory, tolerance
        As for `linear_modes`.

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
    modes = linear_modes(
        blade, omega, count, theory=theory, functions=max(20, 2 * count), tolerance=tolerance
    )
    tangent = modes.steady.linearized
    ratios, sizes = np.empty(count), modes.frequencies / blade.frequency_scale
    for block in modes.steady.blocks:
        parts = (part[0][np.ix_(block, block)] for part in tangent[:0:-1])
        inverse = inverse_eigenvalues(*parts)
        inverse = inverse[inverse.imag < 0.0]
        moving = np.flatnonzero(modes.coordinates[:, block].any(axis=1))
        off = np.abs(1.0 / (np.abs(inverse) * sizes[moving, None]) - 1.0)
        nearest = np.argmin(off, axis=1)
        for k, (mode, found) in enumerate(zip(moving, nearest, strict=True)):
            if off[k, found] > _SAME or found in nearest[:k]:
                raise ValueError(
                    f"mode {mode + 1} is damped so much that it does not oscillate: ask for count="
                    f"{mode} or less, or take less damping"
                )
        # -Re λ/|λ| is -Re(1/λ)/|1/λ|.
        ratios[moving] = -inverse[nearest].real / np.abs(inverse[nearest])
    return ratios


def modal_damping(
    blade: Blade,
    ratios: Mapping[str, float],
    omega: float = 0.0,
    *,
    theory: Theory = BERNOULLI_EULER,
) -> Damping:
    """Return the damping of the section that gives modes their damping ratios.

    It has one coefficient for each family that is named: bending out of the plane for flap, bending
    for lag, torsion, axial. Three modes of three families get their ratios; of more modes than
    families the coefficients are a least-squares fit of the relative errors, none of them negative,
    and a warning has the ratios that they give.

    Parameters
    ----------
    blade : Blade
        What damping it has is replaced.
    ratios : mapping
        Damping ratios ζ [-] by the names of modes of `linear_modes`, as {"flap 1": 0.005}.
    omega : float
        Rotation speed ω [rad/s] at which the modes have them, at rest unless given. Stiffness by
        rotation has no damping, so that ratios fall as the blade turns faster.
    theory : Theory
        As for `linear_modes`.

    Raises
    ------
    ValueError
        If no mode is named, one is named that the blade does not have, or a ratio is not positive.

    Examples
    --------
    >>> from analytic import Blade, damping_ratios, linear_modes
    >>> from analytic.exact.linear.damping import modal_damping
    >>> stiffness = [[1e7, 1e7, 1e7, 8e4, 5e3, 8e4], [4e6, 4e6, 4e6, 1e4, 9e2, 2e4]]
    >>> mass = [[8.0, 0.3, 0.02, 0.28], [4.0, 0.1, 0.01, 0.09]]
    >>> blade = Blade.from_stations([0.0, 10.0], stiffness, mass, twist=[0.2, 0.0])
    >>> damping = modal_damping(blade, {"flap 1": 0.005, "lag 1": 0.01})
    >>> damped = damping_ratios(blade.with_damping(damping), omega=0.0)
    >>> print(*linear_modes(blade, omega=0.0).names, damped.round(4))
    flap 1 lag 1 flap 2 [0.005  0.01   0.0246]
    """
    given = {
        mode_name(blade, omega, name, theory): positive(f"the ratio of {name}", ratio)
        for name, ratio in _pairs(ratios)
    }
    target = np.array(list(given.values()))
    names = linear_modes(blade, omega, _COUNT, theory=theory, functions=2 * _COUNT).names
    if unknown := [name for name in given if name not in names]:
        raise ValueError(
            f"ratios name {', '.join(unknown)}; the {_COUNT} lowest modes of the blade are "
            f"{', '.join(names)}"
        )
    places = [names.index(name) for name in given]
    families = dict.fromkeys(_OF_FAMILY[name.partition(" ")[0]] for name in given)

    def reached(etas: FloatArray) -> FloatArray:
        damping = Damping(**dict(zip(families, etas.tolist(), strict=True)))
        damped = blade.with_damping(damping)
        return damping_ratios(damped, omega, 1 + max(places), theory=theory)[places]

    small = _SMALL / blade.omega_0 / (1 + max(places))
    effect = np.stack([reached(one) / small for one in small * np.eye(len(families))], axis=1)
    etas, found, wanted = np.zeros(len(families)), target, target
    for _ in range(_ROUNDS):
        etas, _ = optimize.nnls(effect / target[:, None], wanted / target)
        found = reached(etas)
        wanted = target - (found - effect @ etas)
    if np.abs(found / target - 1.0).max() > _MET:
        reach = ", ".join(f"{name} {ratio:.3g}" for name, ratio in zip(given, found, strict=True))
        warn(f"no damping of these families gives all ratios; the nearest gives {reach}")
    return Damping(**dict(zip(families, etas.tolist(), strict=True)))


def _pairs(ratios: object) -> list[tuple[str, object]]:
    """Return the names and values of a mapping, or refuse it."""
    if not isinstance(ratios, Mapping) or not ratios:
        raise ValueError(f"ratios must name modes, as {{'flap 1': 0.005}}, got {shown(ratios)}")
    return list(ratios.items())
