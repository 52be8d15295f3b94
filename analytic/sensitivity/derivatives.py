"""How an exact answer changes with the numbers of its blade."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.driven.forced_orbits import ForcedResponse
from ..exact.driven.response import SpinUpResponse
from ..exact.free.orbits import Orbits
from ..exact.linear.families import LinearModes
from ..exact.linear.steady_state import SteadyState
from ..input_checks import shown
from ..load import Load
from ..plotting import tornado
from ..reduced.model import ReducedModel
from ..theory import Theory
from ..threads import one_thread
from .frequencies import FrequencyDerivatives
from .models import ModelDerivatives
from .orbits import OrbitDerivatives, ResponseDerivatives
from .parameters import Parameter, parameters_by, parameters_of
from .spin_ups import SpinUpDerivatives
from .steady import SteadyDerivatives

if TYPE_CHECKING:
    from ..plotting import Axes

Answer = LinearModes | SteadyState | Orbits | ForcedResponse | SpinUpResponse | ReducedModel


class Derivatives(Protocol):
    """Derivatives of the numbers of an answer."""

    parameters: dict[str, Parameter]
    given: tuple[Any, Sequence[Load]]
    conditions: dict[str, Parameter]
    each_station: ClassVar[bool]
    """Whether numbers of single stations are taken unless others are named."""
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    values: FloatArray

    def __init__(self, answer: Any) -> None:
        """Take the answer's own tangent."""

    def columns(self, several: Sequence[Parameter]) -> FloatArray:
        """Return derivatives of all numbers to `parameters`, in their units, (numbers, n)."""

    def again(self, blade: Blade, motion: Any, loads: Sequence[Load]) -> dict[str, float]:
        """Return the numbers of another blade, in another motion, under other loads, by name."""


_KINDS: dict[type, type[Derivatives]] = {
    LinearModes: FrequencyDerivatives,
    SteadyState: SteadyDerivatives,
    Orbits: OrbitDerivatives,
    ForcedResponse: ResponseDerivatives,
    SpinUpResponse: SpinUpDerivatives,
    ReducedModel: ModelDerivatives,
}


@dataclass(frozen=True)
class Sensitivity:
    """How the numbers of an answer change with those of its blade.

    Attributes
    ----------
    answer : LinearModes, SteadyState, Orbits, ForcedResponse, SpinUpResponse or ReducedModel
    outputs : tuple of str
        Its numbers: names of modes; "tip x" and so on in the frame of `steady_state`, "twist",
        and "root force x" and "root moment x" with which the blade acts on the clamp; of orbits
        "frequency at a = 0.1", and "softening at a = 0.1", (1 - ω_NL/ω_n)/a²; of a forced response
        "peak at 3.7 rad/s", |q|/L at the frequencies given, and where it is greatest or least.
        Of a spin-up "largest tip x" and so on, the value farthest from zero; "swing after the
        ramp", half of the tip's lag from peak to peak; and "tip x at 1.5 s" at each of its times.
        Of a reduced model "omega_n", "lambda_omega", "lambda_x" and "kappa".
    units : tuple of str
        Of the outputs.
    values : ndarray (outputs,)
    parameters : tuple of Parameter
    derivatives : ndarray (outputs, parameters)
        Of the outputs to the parameters, in their units.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from analytic.sensitivity import sensitivity
    >>> found = sensitivity(linear_modes(Beam.reference(), omega=6.0, count=1))
    >>> print(f"{found.of('lag 1', 'hub_radius'):.3f} rad/s per m")
    0.920 rad/s per m
    >>> axes = found.plot()
    """

    answer: Answer
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    values: FloatArray
    parameters: tuple[Parameter, ...] = field(repr=False)
    derivatives: FloatArray = field(repr=False)

    @property
    def blade(self) -> Blade:
        """The answer's blade."""
        return self.answer.blade

    @property
    def omega(self) -> Any:
        """Its rotation speed [rad/s], of a forced response at all its points, after a spin-up."""
        return self.answer.omega

    @property
    def theory(self) -> Theory:
        """Its theory."""
        return self.answer.theory

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(one.name for one in self.parameters)

    @property
    def relative(self) -> FloatArray:
        """Relative change of an output over that of a parameter, p/y ∂y/∂p.

        Zero where the parameter is zero, not a number where the output is, (outputs, parameters).
        """
        now = np.array([one.value for one in self.parameters])
        values = np.where(self.values == 0.0, np.nan, self.values)
        return np.asarray(self.derivatives * now / values[:, None])

    def of(self, output: str, parameter: str) -> float:
        """Return one derivative by names."""
        row, column = place_of(output, self.outputs), place_of(parameter, self.names)
        return float(self.derivatives[row, column])

    def over_time(self, number: str) -> FloatArray:
        """Return derivatives of a spin-up's number, as "tip y", over time, (times, parameters)."""
        return np.asarray(self.derivatives[rows_over_time(self.answer, self.outputs, number)])

    def plot(self, output: str | None = None, ax: Axes | None = None) -> Axes:
        """Draw what a small change of each parameter does to an output, the largest first.

        One percent, one degree of an angle, or a small part of the length, as `Parameter.step`.

        Parameters
        ----------
        output : str, optional
            Its name; the first, unless given.
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        """
        row = place_of(output, self.outputs)
        names = [f"{one.name} {one.change}" for one in self.parameters]
        changes = self.derivatives[row] * [one.step for one in self.parameters]
        label = f"change of {self.outputs[row]} [{self.units[row]}]"
        return tornado(names, changes, label, ax)


def rows_over_time(answer: Answer, outputs: Sequence[str], number: str) -> list[int]:
    """Return the places of a spin-up's number at all its times."""
    rows = [k for k, name in enumerate(outputs) if name.startswith(f"{number} at ")]
    if not isinstance(answer, SpinUpResponse) or not rows:
        raise ValueError(
            f"there is no {shown(number)} over time: the answer must be a spin-up, and the number "
            "'tip y' or another"
        )
    return rows


def place_of(name: str | None, among: Sequence[str]) -> int:
    """Return the place of a name among others, of None the first."""
    if name is not None and name not in among:
        raise ValueError(f"there is no {shown(name)}: known are {', '.join(among)}")
    return 0 if name is None else list(among).index(name)


def kind_of(answer: Any) -> Derivatives:
    """Return the derivatives of an answer; TypeError of anything else."""
    kind = _KINDS.get(type(answer))
    if kind is None:
        raise TypeError(
            "answer must be what linear_modes, steady_state, periodic_orbits, forced_response, "
            f"spin_up_response or reduced_model returns, got {shown(answer)}"
        )
    return kind(answer)


@one_thread
def sensitivity(answer: Answer, parameters: Iterable[str] | None = None) -> Sensitivity:
    """Return how an exact answer changes with the numbers of its blade.

    Frequencies of modes; tip, twist and root loads of a steady state and of a spin-up over time;
    frequencies of orbits at their amplitudes; peaks of a forced response; numbers of a reduced
    model. By the answer's own tangent. Nothing is solved anew but what starts a motion. Modes in
    the plane of bending alone where the section out of it is unknown.

    Parameters
    ----------
    answer : LinearModes, SteadyState, Orbits, ForcedResponse, SpinUpResponse or ReducedModel
        Of `linear_modes`, where a mode that meets another at its frequency has no derivative; of
        `steady_state`, `periodic_orbits`, `forced_response`, `spin_up_response`, `reduced_model`.
    parameters : iterable of str, optional
        Names out of `parameters_of`, and numbers of the motion and the loads: "omega" [rad/s],
        "ramp_time" [s] and "start" [rad/s], where they are given, and "loads[0]", a factor of the
        first load. All, unless given; of a spin-up those of the whole blade.

    Raises
    ------
    ValueError
        If the answer has no parameter of a name.

    Examples
    --------
    >>> from analytic import Beam, Theory, linear_modes
    >>> from analytic.sensitivity import sensitivity
    >>> modes = linear_modes(Beam.reference(), omega=6.0, theory=Theory(extension=False))
    >>> found = sensitivity(modes, ["EI3", "m"])
    >>> print(found.relative.round(3))
    [[ 0.341 -0.341]
     [ 0.314 -0.314]
     [ 0.407 -0.407]]
    """
    found = kind_of(answer)
    of_blade = parameters_of(answer.blade, answer.theory)
    known = {name: found.parameters[name] for name in of_blade if name in found.parameters}
    known |= found.conditions
    if parameters is None:
        parameters = [n for n, one in known.items() if found.each_station or not one.family]
    several = parameters_by("parameters", parameters, known)
    return Sensitivity(
        answer=answer,
        outputs=found.outputs,
        units=found.units,
        values=found.values,
        parameters=tuple(several),
        derivatives=found.columns(several).reshape(len(found.outputs), len(several)),
    )
