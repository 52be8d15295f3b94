"""The model about its rotating equilibrium, undamped: mass, stretch, natural frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np

from analytic import Blade
from analytic.arrays import ComplexArray, FloatArray
from analytic.blade_checks import require_blade, require_steady_state, undamped, warn_if_rpm
from analytic.input_checks import rotation_speed, whole_number
from analytic.loads import Load
from analytic.methods.system import inverse_eigenvalues

from ..runs.check import SimulationError, require_stretch, warn_if_coarse
from .columns import twist
from .elements import Formulation, formulation
from .elements.energy_body import add_force
from .lazily import exudyn
from .loading import Loading
from .rotating_beam import add_rotating_beam
from .solver import exudyn_system, static_settings
from .units import Units


@dataclass(frozen=True, kw_only=True)
class Linearization:
    """A mesh about its rotating equilibrium, M ü + G u̇ + K u = 0, in the beam's units.

    Attributes
    ----------
    mass : ndarray (n, n)
        Of the free coordinates, as the two that follow.
    stiffness : ndarray (n, n)
    gyroscopic : ndarray (n, n)
    tip : ndarray (dimensions,)
        Displacement of the tip by rotation and weight, in the axes of the clamp.
    twist : float
        Of the tip's section about its normal [rad], as of `simulate`; NaN in the plane.
    units : Units
    mesh : str
        The elements and the speed, in words.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu.fem.linearization import Linearization
    >>> print(f"{Linearization.of(Beam.reference(), omega=6.0).stretch:.2e} m")
    2.47e-04 m
    """

    mass: FloatArray
    stiffness: FloatArray
    gyroscopic: FloatArray
    tip: FloatArray
    twist: float
    units: Units
    mesh: str

    @classmethod
    def of(
        cls,
        blade: Blade,
        omega: float,
        element: str | Formulation = "cable",
        elements: int = 16,
        weight: Sequence[Load] = (),
    ) -> Linearization:
        """Linearize a mesh, however coarse, at ω [rad/s]; refuse a speed without equilibrium.

        `weight` are loads that stand still in the turning frame.
        """
        omega = rotation_speed(omega)
        warn_if_rpm(blade, omega)
        require_steady_state(blade, omega)
        require_stretch(blade)
        model, units = formulation(element), Units.of(blade)
        unit_beam, w_bar = units.blade(undamped(blade)), omega * units.time
        # A blade that bends in rotation has several equilibria: that from rest is followed, by a
        # speed that the static solution raises from zero at t = 0 to w̄ at 1.
        rotation: Any = SimpleNamespace(
            angle=lambda t: 0.0, rate=lambda t: w_bar * t, acceleration=lambda t: 0.0
        )
        settings = static_settings(unit_beam, elements)
        with exudyn_system() as mbs:
            built = add_rotating_beam(
                mbs, unit_beam, rotation, element=model, elements=elements, frame="rotating"
            )
            if weight:
                loading = Loading(model, unit_beam, elements, built.mass, units.loads(weight))
                shape, none = (1, len(built.nodes), -1), np.zeros(1)
                add_force(
                    mbs, built.nodes,
                    force=lambda t, e, rates: t * loading.forces(none, none, e.reshape(shape))[0],
                    derivatives=lambda t, e: [(loading.slopes(0.0, e.reshape(shape[1:])), t, 0.0)],
                )  # fmt: skip
            mbs.Assemble()
            try:
                mbs.SolveStatic(settings, updateInitialValues=True)
            except Exception as error:
                raise SimulationError(
                    f"no steady state found at omega = {omega:g} rad/s: check the axial stiffness "
                    f"EA = {blade.axial_stiffness:g} N and the speed"
                ) from error
            unloaded = built.chain.reference(mbs)[-1]
            moved = mbs.GetNodeOutput(built.nodes[-1], exudyn.OutputVariableType.Coordinates)
            arm = model.arms(unit_beam, elements)[-1]
            settings.staticSolver.loadStepStart = 1.0  # when the speed is reached
            linear: Any = mbs.ComputeLinearizedSystem(settings, projectIntoConstraintNullspace=True)
        mass, stiffness, gyroscopic = (np.asarray(m) for m in linear[:3])
        # Undamped, and at rest in the frame: what is not symmetric is round-off, which would grow.
        stiffness = 0.5 * (stiffness + stiffness.T)
        axes, ends = model.line_frame(blade), np.stack((unloaded, unloaded + moved))
        moved, turned = np.diff(model.line(arm, ends), axis=0)[0], np.nan
        if model.twists:
            before, after = model.sections(ends)
            turned = twist((axes.T @ after @ before.T @ axes)[None])[0]
        return cls(
            mass=mass, stiffness=stiffness, gyroscopic=gyroscopic,
            tip=moved[: model.dimensions] @ axes, twist=float(turned), units=units,
            mesh=f"{elements} {model.name!r} elements at omega = {omega:g} rad/s",
        )  # fmt: skip

    @cached_property
    def _inverse(self) -> ComplexArray:
        """1/λ of λ² M + λ G + K = 0."""
        return inverse_eigenvalues(self.mass, self.gyroscopic, self.stiffness)

    @property
    def stretch(self) -> float:
        """Displacement of the tip along the blade by the rotation [m].

        To leading order in μ it is Δl_ω = mω²L²/(3EA), Eq. 67. The exact stretch tan(kL)/k - L,
        with k = ω √(ρ/E), is larger by the factor 1 + (2/5)(kL)².
        """
        return float(self.tip[0]) * self.units.length

    @property
    def growth_rate(self) -> float:
        """Largest real part of λ [1/s] beyond what round-off gives to undamped modes, else zero.

        Zero for every element that describes large deformation; for the linear floating frame it
        is √(ω² - ω0²) above ω0, but for the axial coupling, of the order of μ.
        """
        growing = self._inverse[self._inverse.real > 1e-6 * np.abs(self._inverse).max()]
        return float((1.0 / growing).real.max()) / self.units.time if growing.size else 0.0

    def frequencies(self, count: int) -> FloatArray:
        """Return the lowest `count` natural frequencies [rad/s]; see `natural_frequencies`."""
        if whole_number("count", count) > self.mass.shape[0]:
            raise ValueError(
                f"count = {count} is more than the {self.mass.shape[0]} modes of {self.mesh}; "
                "take more elements"
            )
        if self.growth_rate > 0.0:
            raise SimulationError(
                f"the steady state of {self.mesh} is unstable, it grows with "
                f"{self.growth_rate:.6g} 1/s: lower the speed or take another element"
            )
        slowest = np.sort(np.abs(self._inverse.imag))[::-1][: 2 * count : 2]
        return np.asarray(1.0 / slowest) / self.units.time

    def frequency_near(self, frequency: float) -> float:
        """Return the natural frequency [rad/s] that is nearest in ratio to a given one."""
        return nearest(self.frequencies(self.mass.shape[0]), frequency)[1]


def nearest(frequencies: FloatArray, frequency: float) -> tuple[int, float]:
    """Return place and value of the frequency that is nearest in ratio to a given one."""
    place = int(np.argmin(np.abs(np.log(frequencies / frequency))))
    return place, float(frequencies[place])


def natural_frequencies(
    blade: Blade,
    omega: float,
    *,
    element: str | Formulation = "cable",
    elements: int = 16,
    count: int = 3,
) -> FloatArray:
    """Natural frequencies [rad/s] of the finite element model in steady rotation, ascending.

    Small undamped vibration about the equilibrium in rotation, Coriolis and centrifugal terms
    included: the ω_n to which a nonlinear frequency of the same mesh belongs. In the plane of
    bending, or of an element in space of flap, lag and torsion together. Damping of the blade does
    not count.

    Parameters
    ----------
    blade : Blade
    omega : float
        Steady angular velocity ω [rad/s].
    element, elements
        Formulation and number of elements, as in `simulate`.
    count : int
        How many frequencies.

    Returns
    -------
    ndarray of shape (count,)

    Raises
    ------
    ValueError
        If an input is refused, or the mesh has fewer than `count` modes.
    SimulationError
        If the static equilibrium is not found, or unstable: frequencies would mean nothing.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> for element in ("cable", "exact"):
    ...     found = natural_frequencies(Beam.reference(), omega=6.0, element=element, elements=8)
    ...     print(element, found.round(4))
    cable [ 3.7311 23.0152 56.6964]
    exact [ 3.7282 23.6436 62.3349]
    """
    require_blade(blade)
    warn_if_coarse(blade, rotation_speed(omega), whole_number("elements", elements))
    return Linearization.of(blade, omega, element, elements).frequencies(count)
