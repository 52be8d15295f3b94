"""The codes at hand as entries of the verification: our formulations, and peers installed."""

from __future__ import annotations

import dataclasses

from analytic import AnyBlade, SpinUp, SteadyRotation
from analytic.theory import BERNOULLI_EULER, Theory

from ..fem.elements import Ancf3, Cable, Exact, Formulation, Linear, Substructures
from ..fem.elements.section import shear_share
from ..fem.linearization import mesh_frequencies
from ..fem.simulation import simulate
from ..lazily import xr
from .peers import PEERS, Entry, StateOf, installed, peer

_SECOND = 2.0
_ORDERS: dict[type, float] = {Cable: 4.0, Ancf3: 4.0, Linear: 4.0, Substructures: _SECOND}


def formulation_entry(model: Formulation, elements: int | None = None, step: float = 1e-3) -> Entry:
    """Return the entry of one of our formulations, named with the options that are not default.

    Of second order it has twice as many elements as of fourth, unless told; the paper's element
    goes on to 64.

    Examples
    --------
    >>> from rotbeam_exu.fem.elements import Exact
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> entry = formulation_entry(Exact(nodes=3))
    >>> print(entry.name, entry.own_meshes, entry.step)
    exact nodes=3 (8, 16, 32) 0.001
    """
    order, coupled = _declared_order(model), getattr(model, "law", "") == "coupled"
    meshes: tuple[int, ...] = ()
    if elements is None:
        elements = 32 if order == _SECOND else 16
        # At 8 rad/s its order shows from 16 on; where it locks, coarse meshes say so.
        meshes = (8, 16, 32, 64) if isinstance(model, Ancf3) and not coupled else ()
    options = [
        f"{field.name}={getattr(model, field.name)}"
        for field in dataclasses.fields(model)  # type: ignore[arg-type]
        if getattr(model, field.name) != field.default
    ]

    def spin(
        beam: AnyBlade, spin_up: SpinUp, *, elements: int, duration: float, step: float
    ) -> xr.Dataset:
        return simulate(
            beam, spin_up, element=model, elements=elements, duration=duration, step=step
        )

    def release(
        beam: AnyBlade,
        rotation: SteadyRotation,
        state: StateOf,
        *,
        elements: int,
        duration: float,
        step: float,
    ) -> xr.Dataset:
        return simulate(
            beam, rotation, element=model, elements=elements, duration=duration, step=step,
            initial_state=state,
        )  # fmt: skip

    def first(beam: AnyBlade, omega: float, elements: int) -> float:
        return float(mesh_frequencies(beam, omega, model, elements, 1)[0])

    return Entry(
        name=" ".join([model.name, *options]),
        simulate=spin,
        first_frequency=first,
        # The orbit does not say how thick its sections are, which that law would need to start.
        release=None if coupled else release,
        elements=elements,
        meshes=meshes,
        step=step,
        theory=theory_of(model),
        order=order,
    )


def theory_of(model: Formulation) -> Theory:
    """Return the theory of a formulation's beam: shear and rotary inertia, where it has them."""
    if not isinstance(model, Exact | Ancf3):
        return BERNOULLI_EULER
    share = shear_share(model.poisson_ratio, model.shear_correction)
    return Theory(rotary_inertia=True, shear=share)


def _declared_order(model: Formulation) -> float | None:
    """Order in the mesh: of quadratic functions and two points twice that of linear and one."""
    if isinstance(model, Exact):
        return 2.0 * (model.nodes - 1)
    return _ORDERS.get(type(model))


def entries_at_hand() -> tuple[Entry, ...]:
    """Return all formulations of ours worth a row, and the other codes that are installed."""
    models: tuple[Formulation, ...] = (
        Cable(), Exact(), Exact(nodes=3), Ancf3(), Ancf3(law="coupled"), Linear(), Substructures(),
    )  # fmt: skip
    ours = tuple(formulation_entry(model) for model in models)
    return ours + tuple(peer(name) for name in PEERS if installed(name))
