"""Loads on a discretization: those that keep their directions, and those that follow its sections.

A load is a complex force in the frame of the clamp, per mass (gravity), per length, or at the tip;
or force and moment on the span. A ripple of the speed is no force but changes w and ẇ.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...blade import Blade
from ...blade_checks import require_blade
from ...input_checks import points_of_beam
from ...loads import Load, require_load


def unit_load(blade: Blade, load: Load) -> Load:
    """Return a load without dimensions, in units of L, m0 L and √(m0 L⁴/EI0)."""
    require_blade(blade)
    require_load(load)
    loaded((load,), blade)
    return load.in_units(
        blade.length, blade.mass_per_length * blade.length, 1.0 / blade.frequency_scale
    )


def loaded(loads: Iterable[Load], blade: Blade) -> tuple[float, ...]:
    """Return the places over L where loads on the span begin, end or act on a point."""
    ends = set[float]()
    for load in loads:
        if load.stations:
            at = points_of_beam(f"the places of {load}", load.stations, blade.length)
            ends |= set(at[[0, -1]].tolist())
    return tuple(sorted(ends))


def pushes(
    model: Any, loads: Sequence[tuple[Load, FloatArray]], angle: FloatArray
) -> tuple[Any, tuple[Any, ...]]:
    """Return what loads at phases (samples,) push, and what of them follows, as a model takes it.

    Of loads without dimensions; None without a push.
    """
    total: Any = None
    follow = []
    for load, phase in loads:
        if load.acts_on is None:
            continue
        if load.acts_on == "span":
            span = model.span(tuple(np.minimum(load.stations, 1.0)))
            wrench = np.moveaxis(span.weights[:, None] * load.wrench(phase, span.x), 2, 0)
            acting = wrench.reshape(2, 3, *wrench.shape[1:]).swapaxes(0, 1)
            if load.following:
                follow.append((span, acting))
                continue
            push = model.push_on(span, acting)
        else:
            force, lift = load.force(phase, angle, model.setting), load.lift(phase)
            push = model.push(force, load.acts_on, lift)
        total = push if total is None else total + push
    return total, tuple(follow)
