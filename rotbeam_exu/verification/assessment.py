"""Assessment of a run's frequencies against the exact beam, mesh and step apart."""

from __future__ import annotations

import math
from dataclasses import dataclass

import analytic
from analytic.exact.linear.modes import driven_modes

from ..fem.case import RunCase
from ..fem.elements import formulation
from ..fem.linearization import Linearization, nearest
from ..fem.mesh import Mesh
from ..runs.oscillation import SteadyOscillation

WORTH = 1e-2
"""Share of the nonlinear effect that an error may reach before it is warned of."""

_STAYS = 0.5
"""Share of the error of ω_n that twice the elements leave, above which it is not the mesh's.

Elements of second order leave a quarter, of fourth a sixteenth.
"""

_SMALL = 0.05
"""Amplitude over L whose nonlinear effect, 5e-5 or less of the frequency, few meshes show."""

_FINEST = 128
"""Elements above which a mesh is not compared with a finer one: 1024 take minutes."""

_NOISE = 1e-7
"""Relative error of ω_n below which a finer mesh need not improve it: of the eigenvalues."""

_DRIVEN = 6
"""Modes among which that of a run in space is sought; a spin-up moves the lowest."""


@dataclass(frozen=True, kw_only=True)
class Assessment:
    """Frequencies of a run, compared with the exact, extensible beam of its element's theory.

    Attributes
    ----------
    theory : str
        Bernoulli-Euler, or Timoshenko for elements with shear and rotary inertia.
    mode : str
        The exact blade's mode whose frequency is nearest to that of the run: a twisted blade's tip
        may swing in flap. In the plane it is lag 1.
    omega_n, refined_omega_n, exact_omega_n : float
        Natural frequency of the mesh, of one twice as fine, and of the exact beam [rad/s]. That of
        twice as fine is NaN where the mesh is very fine, or the blade has stations.
    amplitude, frequency : float
        Amplitude over L of the run, and its nonlinear frequency ω_NL [rad/s].
    exact_frequency : float
        Frequency of the exact beam's periodic orbit at the run's own amplitude [rad/s].
    why_not : str
        Why the exact orbit cannot be had, where it cannot; its frequency is then NaN.
    """

    theory: str
    mode: str
    omega_n: float
    refined_omega_n: float
    exact_omega_n: float
    amplitude: float
    frequency: float
    exact_frequency: float
    why_not: str = ""

    @property
    def mesh_error(self) -> float:
        """Relative error of ω_n: the mesh, for no step enters it.

        That of ω_NL grows with the amplitude: 16 cables at 6 rad/s have 1.25e-5, at 0.32 L 1.8e-5.
        """
        return self.omega_n / self.exact_omega_n - 1.0

    @property
    def refined_error(self) -> float:
        """Relative error of ω_n of a mesh twice as fine."""
        return self.refined_omega_n / self.exact_omega_n - 1.0

    @property
    def elsewhere(self) -> bool:
        """Whether a finer mesh would not help: its limit is another frequency."""
        return abs(self.refined_error) > max(_STAYS * abs(self.mesh_error), _NOISE)

    @property
    def error(self) -> float:
        """Relative error of ω_NL at the run's own amplitude."""
        return self.frequency / self.exact_frequency - 1.0

    @property
    def step_error(self) -> float:
        """The error of ω_NL beyond that of ω_n: the step, and the mesh in the swing."""
        return self.error - self.mesh_error

    @property
    def effect(self) -> float:
        """The nonlinear effect of the exact beam, ω_NL/ω_n - 1."""
        return self.exact_frequency / self.exact_omega_n - 1.0

    @property
    def coarse(self) -> bool:
        """Whether the error of ω_n hides the nonlinear effect; where that is unknown, one in 100.

        Of a limit that is another, no mesh mends it.
        """
        return abs(self.mesh_error) > WORTH * (1.0 if self.why_not else abs(self.effect))

    @property
    def sentence(self) -> str:
        """Verdict on a run whose checks have passed."""
        if not self.coarse:
            return "equations solved"
        why = "element of another limit" if self.elsewhere else "mesh too coarse"
        error = self.mesh_error if self.why_not else self.error
        return f"equations solved; {why}, {100.0 * error:+.2g} %"

    def _share(self, error: float) -> str:
        """Return how large an error is compared with the nonlinear effect."""
        share = abs(error / self.effect) if self.effect else math.inf
        return f"{share:.1%} of" if share < 1.0 else f"{share:.3g} times"

    def lines(self) -> list[tuple[str, str]]:
        """Return what to print, as titles and texts."""
        lines = [
            (
                "exact ω_n",
                f"{self.exact_omega_n:.6f} rad/s ({self.mode}, {self.theory}); "
                f"error {self.mesh_error:+.1e}, "
                f"{'of another limit' if self.elsewhere else 'due to the mesh'}",
            )
        ]
        if self.why_not:
            return [*lines, ("exact ω_NL", f"cannot be had: {self.why_not}")]
        return [
            *lines,
            (
                "exact ω_NL",
                f"{self.exact_frequency:.6f} rad/s at this amplitude ({self.theory}); "
                f"error {self.error:+.1e} in total; "
                f"relative to ω_n of this mesh {self.step_error:+.1e} (step and mesh)",
            ),
            ("nonlinear effect", f"exact ω_NL/ω_n - 1 = {self.effect:+.3e}"),
        ]

    def warnings(self, elements: int, step: float) -> list[str]:
        """Return a sentence for the mesh and the step, where its error hides the effect."""
        if self.why_not:
            return []
        small = f", or a ramp that leaves more than {self.amplitude:.2g} L" * (
            self.amplitude < _SMALL
        )
        mesh = ("the mesh", self.mesh_error, f"take more elements than {elements}")
        if self.elsewhere:
            mesh = (
                "ω_n",
                self.mesh_error,
                f"with twice the elements it is {self.refined_error:+.1e}, so that no mesh mends "
                f"it; what this element tends to is not the {self.theory} beam",
            )
        return [
            f"the error of {what} is {error:+.1e} of the frequency, {self._share(error)} the "
            f"nonlinear effect, {self.effect:+.1e}: {remedy}{small}"
            for what, error, remedy in (
                mesh,
                (
                    "the step, and the mesh in the swing,",
                    self.step_error,
                    f"take a smaller step than {step:g} s, then more elements than {elements}",
                ),
            )
            if abs(error) > WORTH * abs(self.effect)
        ]


def assess(case: RunCase, steady: SteadyOscillation, *, exact: bool = True) -> Assessment:
    """Compare a run's ω_n and ω_NL with the exact beam's, the latter at the run's own amplitude.

    Parameters
    ----------
    case : RunCase
        The run's inputs.
    steady : SteadyOscillation
        Its oscillation.
    exact : bool
        Whether to compute the exact orbit, which a blade in space takes most of its time for.

    Notes
    -----
    The exact beam is `linear_modes` and `periodic_orbits` of `analytic`: geometrically exact and
    extensible, with shear and rotary inertia where the element has them, which are worth 5e-5.
    """
    model = formulation(case.element)
    theory, count = model.theory_of(case.blade), _DRIVEN if model.leaves_plane else 1
    modes = driven_modes(case.blade, case.omega, count, theory=theory)
    place, exact_omega_n = nearest(modes.frequencies, steady.frequency)
    exact_frequency, why_not = math.nan, "" if exact else "it was not asked for"
    if case.exchanges_energy:
        why_not = "loads and damping make it another than the free orbit's"
    if not why_not:
        try:
            orbit = analytic.periodic_orbits(
                case.blade, case.omega, [steady.amplitude], theory=theory, mode=modes.names[place]
            )
            exact_frequency = float(orbit.frequency[0])
        except (RuntimeError, ValueError) as error:
            why_not = str(error)

    def omega_n(elements: int) -> float:
        if elements > max(2 * _FINEST, case.elements):
            return math.nan
        mesh = Linearization.of(case.blade, case.omega, model, elements)
        return mesh.frequency_near(exact_omega_n)

    # Where sections jump between stations a coarse mesh has no order yet.
    smooth = Mesh(blade=case.blade, elements=case.elements).stations.size == 2
    return Assessment(
        theory=theory.name, mode=modes.names[place], omega_n=omega_n(case.elements),
        refined_omega_n=omega_n(2 * case.elements) if smooth else math.nan,
        exact_omega_n=exact_omega_n,
        amplitude=steady.amplitude, frequency=steady.frequency, exact_frequency=exact_frequency,
        why_not=why_not,
    )  # fmt: skip
