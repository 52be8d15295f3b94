"""Other codes beside ours: the protocol by which one is judged, and those that come with it.

Anyone can have a code of their own judged by `rotbeam_exu.verification.measures.verify`: write a
function with the signature of `Code`, wrap it in an `Entry`, and read the verdict table::

    def mine(beam, spin_up, *, elements, duration, step):
        ...                                   # spin the beam up; sample q [m] and q_dot [m/s]
        return xarray.Dataset({"q": ("time", q), "q_dot": ("time", q_dot)}, {"time": time})

    verify(Entry(name="mine", simulate=mine))

`time` runs from 0 to `duration` [s] in even samples, at least 100 a period of the oscillation;
q and q_dot are Eq. 16: the tip across the line that turns with the clamp, and its rate there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import util
from pathlib import Path
from typing import Protocol

from analytic import AnyBlade, BeamState, SpinUp, SteadyRotation
from analytic.arrays import FloatArray
from analytic.input_checks import whole_number
from analytic.theory import BERNOULLI_EULER, Theory

from ...lazily import xr

FrequenciesOf = Callable[[AnyBlade, float, int], float]
"""First natural frequency [rad/s] of (beam, omega, elements) in steady rotation."""

StateOf = Callable[[FloatArray], BeamState]
"""State at material points x [m]."""


class Released(Protocol):
    """A code that starts a beam which turns already in a given state."""

    def __call__(
        self,
        beam: AnyBlade,
        rotation: SteadyRotation,
        state: StateOf,
        *,
        elements: int,
        duration: float,
        step: float,
    ) -> xr.Dataset:
        """Return what `Code` does; `state` gives the `BeamState` at material points x [m]."""


class Code(Protocol):
    """A code that spins a beam up."""

    def __call__(
        self, beam: AnyBlade, spin_up: SpinUp, *, elements: int, duration: float, step: float
    ) -> xr.Dataset:
        """Return q [m] and q_dot [m/s], Eq. 16, over `time` [s]; raise RuntimeError on failure."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """What is judged: a code, its name and the discretization it is judged at.

    Parameters
    ----------
    name : str
        Shown in the table.
    simulate : Code
        Spins the beam up.
    first_frequency : callable, optional
        (beam, omega, elements) -> first natural frequency [rad/s], where the code has it.
    release : Released, optional
        Starts the beam on an orbit, where the code can.
    elements, step
        Mesh and step [s] of the judged run.
    meshes : tuple of int, optional
        Meshes on which convergence is judged, three or more to have an order; half, the same and
        twice as many elements unless given.
    theory : Theory
        The beam theory whose linear frequencies the code should have; Bernoulli-Euler's by default.
    order, order_in_step : float, optional
        Orders that the author declares, in the mesh and in the step; the observed ones are judged
        against them.
    """

    name: str
    simulate: Code
    first_frequency: FrequenciesOf | None = None
    release: Released | None = None
    elements: int = 16
    step: float = 1e-3
    meshes: tuple[int, ...] = ()
    theory: Theory = BERNOULLI_EULER
    order: float | None = None
    order_in_step: float | None = 2.0

    def __post_init__(self) -> None:
        for elements in (self.elements, *self.meshes):
            whole_number("meshes", elements)

    @property
    def own_meshes(self) -> tuple[int, ...]:
        """Meshes on which convergence is judged, coarse to fine."""
        around = (max(self.elements // 2, 1), self.elements, 2 * self.elements)
        return tuple(sorted(set(self.meshes or around)))


PEERS = ("kratos",)
"""Names of the other codes that come with an adapter."""


class NotInstalledError(ModuleNotFoundError, ValueError):
    """Another code was asked for that is not installed."""


def peer(name: str) -> Entry:
    """Return the entry of another code, with a mesh and step that its order of accuracy needs.

    Raises
    ------
    ValueError
        If the name is not known.
    NotInstalledError
        If the code is not installed; the sentence says how to.
    """
    if name not in PEERS:
        raise ValueError(f"unknown code {name!r}; known are {', '.join(map(repr, PEERS))}")
    if not installed(name):
        raise NotInstalledError(
            "KratosMultiphysics with its StructuralMechanicsApplication is not installed; "
            "pip install '.[peers]' in a clone"
        )
    from . import kratos  # noqa: PLC0415  (not installed everywhere)

    return Entry(name=name, simulate=kratos.simulate, elements=32, step=5e-4, order=2.0)


def installed(name: str) -> bool:
    """Say whether another code is at hand, without importing it: it would print a banner."""
    found = util.find_spec("KratosMultiphysics") if name == "kratos" else None
    return found is not None and any(
        (Path(place) / "StructuralMechanicsApplication").is_dir()
        for place in found.submodule_search_locations or ()
    )
