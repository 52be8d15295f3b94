"""Our formulations as entries of the verification."""

from __future__ import annotations

import dataclasses

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.exact.continuum.unit import space_unit

from ..fem.elements import (
    Ancf3,
    Cable,
    Exact,
    Formulation,
    Linear,
    Substructures,
    require_modeled,
)
from ..fem.linearization import Linearization
from ..fem.simulation import simulate
from ..lazily import xr
from ..runs import Frame
from .case import Case
from .verify import Entry

_SECOND = 2.0


def formulation_entry(model: Formulation, elements: int | None = None, step: float = 1e-3) -> Entry:
    """Return the entry of one of our formulations, named with the options that are not default.

    Of second order it has twice as many elements as of fourth, unless given; the paper's element
    goes on to 64.

    Examples
    --------
    >>> from rotbeam_exu.fem.elements import Exact
    >>> from rotbeam_exu.verification.entries import formulation_entry
    >>> entry = formulation_entry(Exact(nodes=3))
    >>> print(entry.name, entry.own_meshes, entry.step)
    exact nodes=3 (8, 16, 32) 0.001
    """
    options = [
        f"{field.name}={getattr(model, field.name)}"
        for field in dataclasses.fields(model)  # type: ignore[arg-type]
        if getattr(model, field.name) != field.default
    ]

    def frame_of(blade: Blade) -> Frame:
        """Return the frame in which the element takes the blade; refuse one that it does not."""
        turns = model.setting(blade) == 1.0 or not model.constant_mass
        frame: Frame = "inertial" if turns else "rotating"
        try:
            require_modeled(blade, model, frame)
        except ValueError as error:
            raise NotImplementedError(str(error)) from error
        return frame

    def simulated(case: Case, *, elements: int, step: float) -> xr.Dataset:
        frame = frame_of(case.blade)
        if "twist" in case.columns and not model.twists:
            raise NotImplementedError(f"{model.name} has no twist to hand in")
        if not (case.is_spun_up or model.starts_in_motion):
            raise NotImplementedError(f"{model.name} does not start on an orbit")
        data = simulate(
            case.blade, case.rotation, element=model, elements=elements, step=step,
            duration=case.whole_duration(step), loads=case.loads,
            initial_state=case.start, frame=frame,
        )  # fmt: skip
        names = {"q": "lag", "w": "flap"}
        return data.rename({old: new for old, new in names.items() if new in case.columns})

    def lowest(case: Case, omega: float, elements: int) -> FloatArray:
        frame_of(case.blade)
        linear = Linearization.of(case.blade, omega, model, elements)
        return np.asarray(linear.frequencies(case.count))

    def steady_tip(case: Case, omega: float, elements: int) -> FloatArray:
        frame_of(case.blade)
        linear = Linearization.of(case.blade, omega, model, elements, weight=case.loads)
        (unloaded,), _ = space_unit(case.blade).unloaded(np.ones(1))
        place = case.blade.length * (unloaded + linear.tip)
        return np.array([*place[1:], linear.twist])

    return Entry(
        name=" ".join([model.name, *options]),
        simulate=simulated,
        frequencies=lowest,
        in_space=model.leaves_plane,
        steady_tip=steady_tip if model.leaves_plane else None,
        elements=elements or (32 if model.order == _SECOND else 16),
        meshes=() if elements else model.meshes,
        step=step,
        theory=model.theory,
        order=model.order,
    )


def entries_at_hand() -> tuple[Entry, ...]:
    """Return all formulations of ours worth a row."""
    models: tuple[Formulation, ...] = (
        Cable(), Exact(), Exact(nodes=3), Ancf3(), Ancf3(law="coupled"), Linear(), Substructures(),
    )  # fmt: skip
    return tuple(formulation_entry(model) for model in models)
