"""Small vibration of the cable out of the plane, about steady rotation."""

from __future__ import annotations

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.input_checks import whole_number
from analytic.lazily import linalg

from ..linearization import steady_system
from ..units import Units
from .elements import SpaceCable


def flap_frequencies(
    blade: AnyBlade, omega: float, *, elements: int = 16, count: int = 3
) -> FloatArray:
    """Natural frequencies [rad/s] of Exudyn's cable out of the plane of rotation, ascending.

    About the equilibrium stretched by the rotation. Not of the geometrically exact beam, which is
    solved in the inertial frame only.

    Parameters
    ----------
    blade : Blade
        With a section that bends alike in all directions, bending_ratio 1.
    omega : float
        Steady angular velocity ω [rad/s].
    elements : int
        Number of cables.
    count : int
        How many frequencies, at most 2 `elements`.

    Returns
    -------
    ndarray of shape (count,)

    Raises
    ------
    ValueError
        If an input is refused, or the mesh has fewer than `count` modes.
    SimulationError
        If the static equilibrium is not found.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import flap_frequencies
    >>> blade = Beam.reference().with_section_out_of_plane(bending_ratio=1.0)
    >>> print(flap_frequencies(blade, omega=6.0, elements=8).round(4))
    [ 7.0656 23.7847 57.0132]
    """
    model = SpaceCable()
    model.require_section(blade)
    modes = 2 * whole_number("elements", elements)
    if whole_number("count", count) > modes:
        raise ValueError(
            f"count = {count} is more than the {modes} modes of {elements} cables out of the "
            "plane; take more elements"
        )
    with steady_system(blade, omega, model, elements) as (mbs, _, settings):
        mass, stiffness = mbs.ComputeLinearizedSystem(settings)[:2]
    # Coordinates are (x, y, z) of r and r' in turn; the clamp holds those of the first node.
    across = np.arange(2, 6 * (elements + 1), 3)[2:]
    squares = linalg.eigh(
        np.asarray(stiffness)[np.ix_(across, across)],
        np.asarray(mass)[np.ix_(across, across)],
        eigvals_only=True,
    )
    return np.asarray(np.sqrt(squares[:count])) / Units.of(blade).time
