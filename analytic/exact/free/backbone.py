"""The exact backbone: the free orbits that grow out of one mode at one speed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import require_undamped, warn_if_rpm
from ...input_checks import peak_deflection, rotation_speed, whole_number
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..continuum.discretization import continuum_of
from ..continuum.rotation import GAUGES
from ..linear.modes import mode_name
from .branches import BackboneBranch, followed_branch
from .curve import BackboneCurve, settled_curve
from .leaving import LeavingBranch, leaving_branch
from .orbits import Orbits, orbits_of
from .path import ModePath


@dataclass(frozen=True, kw_only=True, eq=False)
class Backbone(ModePath):
    """Free orbits of the exact beam that grow out of one mode at one speed; made by `backbone`.

    It has the beam, omega, mode and theory that are given, computes when it is asked, and keeps its
    path of orbits. In space these are half a Fourier series where time reversal maps the blade onto
    itself and the gauge is odd, a full one elsewhere: with twist and precone, or with precone and
    flap.
    """

    @one_thread
    def orbits(self, amplitudes: float | Sequence[float] | FloatArray) -> Orbits:
        """Return the orbits of peak tip deflections |q|/L, as `periodic_orbits` does."""
        return orbits_of(self, amplitudes)

    @one_thread
    def curve(self, up_to: float = 0.6) -> BackboneCurve:
        """Return the backbone as a series in a², as `backbone_curve` does."""
        return settled_curve(self, peak_deflection("up_to", up_to))

    @one_thread
    def branch(self, up_to: float = 0.9) -> BackboneBranch:
        """Return the backbone up to an amplitude, with its internal resonances.

        The main path is the path of `orbits`, on up to 120 harmonics. If a harmonic meets another
        mode and is felt, the orbits are followed by arclength from either side, through the folds
        of the resonance and a way into its tongue. There the other mode takes over. The lowest four
        other modes are looked at: in the plane if the orbits are (`leaving` has the way out of it),
        of all families in space.

        Parameters
        ----------
        up_to : float
            Largest peak |q|/L, below 1. Where the path ends before, it ends in a fold.

        Raises
        ------
        ValueError
            If `up_to` is refused.
        AmplitudeNotReachedError
            If no orbit grows out of the mode.

        Examples
        --------
        >>> from analytic import Beam, Theory, backbone
        >>> of = backbone(Beam.reference(), omega=4.0, theory=Theory(extension=False))
        >>> for one in of.branch(up_to=0.15).resonances:
        ...     print(f"harmonic {one.harmonic} meets {one.mode} at a = {one.amplitude:.4f}")
        harmonic 16 meets lag 3 at a = 0.1269
        """
        return followed_branch(self, peak_deflection("up_to", up_to))

    @one_thread
    def leaving(
        self, low: float, high: float, *, periods: int = 1, points: int = 30
    ) -> LeavingBranch:
        """Return the orbits in space that leave the plane between two amplitudes.

        They are born at a planar orbit between `low` and `high` at which a Floquet multiplier out
        of the plane is 1, or -1 where their period is twice that of the planar orbit. Followed by
        arclength, each on as many harmonics and functions as it needs.

        Parameters
        ----------
        low, high : float
            Peaks |q|/L of two planar orbits, below 1: one on either side of an edge of instability,
            as `stable` of orbits or `stability_limit` shows it. Of several edges one is found.
        periods : int
            1, or 2 for period doubling.
        points : int
            Number of orbits at most.

        Raises
        ------
        ValueError
            If nothing leaves the plane between them, the section out of it is not known, or the
            orbits are not in a plane.

        Examples
        --------
        >>> from analytic import Beam, Rectangle, backbone
        >>> strip = Beam.reference().with_shape(Rectangle())
        >>> found = backbone(strip, omega=0.0, functions=12).leaving(0.0074, 0.0079, points=2)
        >>> print(f"{found.born.amplitude:.6f}")
        0.007719
        """
        if self.model.beyond(self.blade, self.theory) is None:
            raise ValueError("orbits in space have no plane to leave: take those of lag")
        low, high = peak_deflection("low", low), peak_deflection("high", high)
        if not low < high:
            raise ValueError(f"low must be below high, got {low:g} and {high:g}")
        if whole_number("periods", periods) > 2:
            raise ValueError(f"periods must be 1 or 2, got {periods}")
        return leaving_branch(self, low, high, periods, whole_number("points", points))


def backbone(
    blade: Blade,
    omega: float,
    mode: str | int = "lag 1",
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> Backbone:
    """Return the backbone of a mode: its orbits, their curve, and what branches off.

    Parameters
    ----------
    blade : Blade
        Without damping.
    omega : float
        Rotation speed ω [rad/s].
    mode : str or int
        Mode from which the orbits grow, by its name in `linear_modes`, or by its number there,
        from 1. The amplitude is the peak of the tip in its family, lag or flap. Modes of torsion
        and of axial motion do not move the tip across: they are refused.
    theory : Theory
        Extension, shear and rotary inertia.
    functions : int
        Least number of functions for the tangent's angle, half as many for each curvature in
        space; they grow where an orbit needs more.

    Raises
    ------
    ValueError
        If an argument is out of range, or the mode beyond what the functions resolve.

    Examples
    --------
    >>> from analytic import Beam, backbone
    >>> of = backbone(Beam.reference(), omega=6.0)
    >>> print(f"{of.omega_n:.5f} rad/s, at a = 0.3 {of.orbits(0.3).frequency[0]:.5f} rad/s")
    3.73040 rad/s, at a = 0.3 3.72357 rad/s
    >>> print(f"λ_ω = {of.curve(up_to=0.4).lambda_omega:.5f}")
    λ_ω = 0.01967
    """
    omega = rotation_speed(omega)
    warn_if_rpm(blade, omega)
    require_undamped(blade, "a damped blade has no free periodic orbits")
    name = mode_name(blade, omega, mode, theory)
    family, number = name.split()
    if family not in GAUGES:
        raise ValueError(
            f"the amplitude of orbits is how far the tip moves across, and mode is {name!r}: take "
            "a mode of lag or flap"
        )
    leaves = family == "flap" and blade.section.knows_space
    each = max(functions // 2, 2 * int(number) + 2)
    model = continuum_of(blade, theory, functions, each, mode=int(number), leaves=leaves)
    of = Backbone(blade=blade, omega=omega, mode=name, theory=theory, model=model)
    return replace(of, care=of.care.of_table(model.tail))


def periodic_orbits(
    blade: Blade,
    omega: float,
    amplitudes: float | Sequence[float] | FloatArray,
    mode: str | int = "lag 1",
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> Orbits:
    """Return the periodic orbits of the exact beam that grow out of one mode.

    Geometrically exact, undamped beam in steady rotation; harmonic balance in time on Legendre
    polynomials in space, continued in amplitude. The number of harmonics grows until the Jacobi
    integral is constant to 2e-11, the number of functions until half as many again change the
    frequency by at most 1e-9. Near an internal resonance several orbits may have one amplitude:
    there the branch is computed again on more functions, until it leads to the same orbit.
    `frequency_error` is the remaining uncertainty.

    Parameters
    ----------
    beam, omega, mode, theory, functions
        As for `backbone`.
    amplitudes : float or sequence of float
        Peak tip deflections |q|/L, above 0 and below 1, in any order.

    Raises
    ------
    ValueError
        If an argument is out of range, or the mode beyond what the functions resolve.
    AmplitudeNotReachedError
        If an amplitude is not reached with a small residual; its `.part` are the orbits below.

    Warns
    -----
    RotbeamWarning
        Where a harmonic of an orbit comes within 2 % of another mode's frequency.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> found = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.1, 0.2, 0.3])
    >>> print(found.frequency.round(5))
    [3.72966 3.72742 3.72357]
    >>> print(f"ω_NL = {found.omega_n:.5f} (1 - {found.lambda_omega:.4f} a²) rad/s as a → 0")
    ω_NL = 3.73040 (1 - 0.0197 a²) rad/s as a → 0
    """
    of = backbone(blade, omega, mode, theory=theory, functions=functions)
    return of.orbits(amplitudes)


def backbone_curve(
    blade: Blade,
    omega: float,
    up_to: float = 0.6,
    mode: str | int = "lag 1",
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> BackboneCurve:
    """Return the exact backbone of a mode as a Chebyshev series in a².

    Through nine orbits and the linear mode, on the extrema of Chebyshev's polynomials in a². Where
    the series does not converge to 1e-8 of ω_NL/ω_n and of the first harmonic over the peak, near
    an internal resonance, or the orbits end, its range is made shorter, and `holds_up_to` says how
    far it goes. Resonances so narrow that no orbit shows them are passed unseen: `Backbone.branch`
    lists all.

    Parameters
    ----------
    beam, omega, mode, theory, functions
        As for `backbone`.
    up_to : float
        Largest peak |q|/L asked for, below 1.

    Raises
    ------
    ValueError
        If an argument is refused.
    AmplitudeNotReachedError
        If no orbit grows out of the mode, or the series holds up to less than a tenth of `up_to`.

    Warns
    -----
    RotbeamWarning
        If the series holds less far than asked, with the nearest internal resonance.

    Examples
    --------
    >>> from analytic import Beam, backbone_curve
    >>> curve = backbone_curve(Beam.reference(), omega=6.0)
    >>> round(float(curve.frequency(0.3)), 6), round(curve.lambda_omega, 6)
    (3.723567, 0.019669)
    """
    return backbone(blade, omega, mode, theory=theory, functions=functions).curve(up_to)
