"""Linear modes out of the plane of rotation: flap, as that of a turned blade, and torsion."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...blade import Blade
from ...input_checks import points_of_beam
from ...lazily import linalg
from ...profiles import in_units
from ...settled import refined, settled
from ...shape_functions import shape_functions
from ...theory import BERNOULLI_EULER
from ..beam.discretization import blade_continuum
from ..beam.space import Space, require_out_of_plane, with_points_for
from ..beam.steady import SteadyBeam, steady_rotation

_SETTLED = 1e-9  # relative change of the frequencies, as in `linear_modes`
_MOST_FUNCTIONS = 256


@dataclass(frozen=True, kw_only=True)
class TorsionModes:
    """Modes of the twist; made by `linear_modes` with plane="torsion".

    Attributes
    ----------
    beam : Blade
    omega : float
        Rotation speed ω [rad/s].
    frequencies : ndarray (count,)
        [rad/s], ascending. Of a section that is free to warp: a clamp that holds the warping
        raises them by a quarter of its depth over the length, 0.1 % for the paper's rectangle.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, linear_modes
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> twist = linear_modes(strip, 6.0, 2, plane="torsion")
    >>> print(twist.frequencies.round(1))
    [ 65.1 194.3]
    """

    beam: AnyBlade
    omega: float
    frequencies: FloatArray
    _coordinates: FloatArray = field(repr=False)

    def shapes(self, x: ArrayLike) -> FloatArray:
        """Return the twists φ at `x` [m], (points, count), 1 at the tip."""
        at = points_of_beam("x", x, self.beam.length)
        twists = shape_functions(self.beam.unit, len(self._coordinates))
        tip = twists.once(np.ones(1)) @ self._coordinates
        return np.asarray(twists.once(at) @ self._coordinates / tip)


def flap_blade(beam: AnyBlade) -> Blade:
    """Return the blade whose plane of bending is the one normal to the plane of rotation.

    With the bending stiffness that the section has there. The inertia of slices and of point masses
    against rotation is known in the plane only, and left out.
    """
    section = require_out_of_plane(beam, torsion=False)
    return replace(
        beam.blade,
        setting_angle=0.5 * math.pi,
        section=replace(
            beam.section,
            bending_stiffness=in_units(
                beam.section.bending_stiffness, 1.0, 1.0 / section.bending_ratio
            ),
            rotary_inertia=0.0,
            out_of_plane=None,
        ),
        point_masses=tuple(replace(one, inertia=0.0) for one in beam.point_masses),
    )


def torsion_modes(beam: AnyBlade, omega: float, count: int, functions: int) -> TorsionModes:
    """Return the modes of ∫(GJ + Nk²) φ'² + ιω²φ² and ∫j φ̇²; see `analytic.exact.beam.space`.

    N is the tension of the rotation, and with k² = (EI + EI_out)/EA that is the trapeze effect;
    ι is the section's inertia in the plane of rotation less that across it, the propeller moment.
    Of the paper's rectangle at 12 rad/s the first is at 64.49 rad/s without either, at 65.59 with
    the propeller moment alone, and at 66.75 with both.

    Raises
    ------
    ValueError
        If the section's torsional stiffness is unknown or infinite, or its polar inertia is zero;
        if the rotation tears the blade, or twists it, of an inertia larger than the tension holds.
    """
    section = require_out_of_plane(beam, torsion=False)
    if section.torsion_ratio is None or math.isinf(section.torsion_ratio):
        raise ValueError(
            "torsion has no modes where torsion_ratio is unknown or infinite: give GJ/EI by "
            "with_section_out_of_plane or with_shape"
        )
    if section.polar_inertia == 0.0:
        raise ValueError(
            "torsion has no modes without polar inertia: leave polar_inertia out, for that of a "
            "homogeneous section"
        )
    functions = max(functions, 2 * count)
    model = blade_continuum(beam, BERNOULLI_EULER, functions, functions // 2)
    steady = steady_rotation(beam, omega, model)
    _, found, change = settled(
        lambda size: _torsion(steady, beam, size),
        refined(functions, lambda size: 3 * size // 2, lambda most: most > _MOST_FUNCTIONS),
        _SETTLED,
        lambda found: np.log(found[0][:count]),
    )
    if change > _SETTLED:
        raise ValueError(
            f"{count} torsional frequencies have not settled to {_SETTLED:g} with "
            f"{len(found[1])} functions: ask for fewer"
        )
    return TorsionModes(
        beam=beam,
        omega=omega,
        frequencies=found[0][:count] * beam.frequency_scale,
        _coordinates=found[1][:, :count],
    )


def _torsion(steady: SteadyBeam, beam: AnyBlade, functions: int) -> tuple[FloatArray, FloatArray]:
    """Return the nondimensional frequencies and the coordinates (n, modes)."""
    space = Space(beam, functions)
    stiffness = space.twist_stiffness(with_points_for(steady, space.functions))
    try:
        # In 1/ν², for the highest would round the lowest off.
        inverse, shapes = linalg.eigh(space.twist_mass, stiffness)
    except linalg.LinAlgError as error:
        speed = steady.rate * beam.frequency_scale
        raise ValueError(
            f"at omega = {speed:g} rad/s the rotation turns the section over, whose polar_inertia "
            "is more than the tension and GJ hold: rotate slower, or leave polar_inertia out, for "
            "that of a homogeneous section"
        ) from error
    kept = inverse > 0.0
    return 1.0 / np.sqrt(inverse[kept][::-1]), shapes[:, kept][:, ::-1]
