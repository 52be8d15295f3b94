"""The codes at hand as entries of the verification: our formulations, and peers installed."""

from __future__ import annotations

import dataclasses

from analytic import AnyBlade, SpinUp, SteadyRotation

from ..fem.elements import Ancf3, Cable, Exact, Formulation, Linear, Substructures
from ..fem.linearization import Linearization
from ..fem.simulation import simulate
from ..lazily import xr
from .peers import PEERS, Entry, StateOf, installed, peer


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
    meshes: tuple[int, ...] = ()
    if elements is None:
        elements = 32 if model.order == 2.0 else 16
        meshes = model.meshes
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
        return float(Linearization.of(beam, omega, model, elements).frequencies(1)[0])

    return Entry(
        name=" ".join([model.name, *options]),
        simulate=spin,
        first_frequency=first,
        release=release if model.starts_in_motion else None,
        elements=elements,
        meshes=meshes,
        step=step,
        theory=model.theory,
        order=model.order,
    )


def entries_at_hand() -> tuple[Entry, ...]:
    """Return all formulations of ours worth a row, and the other codes that are installed."""
    models: tuple[Formulation, ...] = (
        Cable(), Exact(), Exact(nodes=3), Ancf3(), Ancf3(law="coupled"), Linear(), Substructures(),
    )  # fmt: skip
    ours = tuple(formulation_entry(model) for model in models)
    return ours + tuple(peer(name) for name in PEERS if installed(name))
