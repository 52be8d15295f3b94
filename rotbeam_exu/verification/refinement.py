"""Runs of a case in the order of their meshes and of their steps, and their limits."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from analytic.arrays import FloatArray

from .convergence import Convergence, convergence, convergence_of_functions
from .submission import Declaration, Run


@dataclass(frozen=True, kw_only=True)
class Refinement:
    """Runs refined in the mesh at one step, and in the step on one mesh, the finest last.

    Attributes
    ----------
    meshes : tuple of Run
        At one step; where no two runs share one, meshes whose steps shrink with them.
    steps : tuple of Run
        On one mesh; empty if there are not two of them.
    """

    meshes: tuple[Run, ...]
    steps: tuple[Run, ...]

    @property
    def finest(self) -> Run:
        """Run of the finest mesh, at its smallest step."""
        return max((*self.meshes, *self.steps), key=lambda run: (run.elements, -run.step))

    @property
    def steps_are_refined(self) -> bool:
        """True where the error of the step can be told, by itself or together with the mesh's."""
        return bool(self.steps) or len({run.step for run in self.meshes}) > 1


def refinement(runs: Sequence[Run]) -> Refinement:
    """Return the longest rows of meshes and of steps; of equally long ones the finest."""
    at_step: dict[float, dict[int, Run]] = defaultdict(dict)
    on_mesh: dict[int, dict[float, Run]] = defaultdict(dict)
    for run in runs:
        at_step[run.step][run.elements] = run
        on_mesh[run.elements][run.step] = run
    step = min(at_step, key=lambda h: (-len(at_step[h]), h))
    meshes = [at_step[step][n] for n in sorted(at_step[step])]
    if len(meshes) == 1 and len(on_mesh) > 1:
        return Refinement(
            meshes=tuple(on_mesh[n][min(on_mesh[n])] for n in sorted(on_mesh)), steps=()
        )
    mesh = max(on_mesh, key=lambda n: (len(on_mesh[n]), n))
    steps = [on_mesh[mesh][h] for h in sorted(on_mesh[mesh], reverse=True)]
    return Refinement(meshes=tuple(meshes), steps=tuple(steps) if len(steps) > 1 else ())


def limit_of_numbers(
    rows: Refinement, measured: Mapping[Run, tuple[float, float]], declaration: Declaration
) -> Convergence:
    """Return the limit of a number in mesh and step together, as the convergence in the mesh.

    `measured` has the number that each run showed, and the bar of what measured it.
    """

    def of(runs: tuple[Run, ...], sizes: list[float], declared: float | None) -> Convergence:
        values, noise = zip(*(measured[run] for run in runs), strict=True)
        return convergence(sizes, values, noise=noise, declared=declared)

    mesh = of(rows.meshes, _mesh_sizes(rows), declaration.order)
    if not rows.steps:
        return mesh
    step = of(rows.steps, _steps(rows), declaration.order_in_step)
    number, growth = _nearest_step(rows, declaration)
    limit = mesh.limit - growth * float(step.errors[number])
    return _both(mesh, step, limit=limit, values=mesh.values, errors=mesh.values - limit)


def limit_of_histories(
    rows: Refinement, histories: Mapping[Run, FloatArray], noise: float, declaration: Declaration
) -> tuple[Convergence, Convergence | None, FloatArray]:
    """Return the limit of histories in mesh and step together.

    They are over the scale by which they are measured, at the same times; `noise` is their largest
    error that neither mesh nor step explains.

    Returns
    -------
    runs : Convergence
        In the mesh, of the largest size of the history; its limit is the last history's.
    steps : Convergence or None
        In the step alone, lengths of way as of `convergence_of_functions`.
    limit : ndarray (samples,)
    """
    f = np.array([histories[run] for run in rows.meshes])
    mesh, limit = convergence_of_functions(
        _mesh_sizes(rows), f, noise=noise, declared=declaration.order
    )
    step = None
    if rows.steps:
        g = np.array([histories[run] for run in rows.steps])
        step, settled = convergence_of_functions(
            _steps(rows), g, noise=noise, declared=declaration.order_in_step
        )
        number, growth = _nearest_step(rows, declaration)
        limit = limit - growth * (g[number] - settled)
    sizes, size = np.abs(f).max(axis=1), float(np.abs(limit).max())
    errors = np.abs(f - limit).max(axis=1)
    if math.isnan(mesh.limit):
        return replace(mesh, values=sizes), step, limit
    whole = _both(mesh, step, limit=size, values=sizes, errors=errors)
    return whole, step, limit


def _mesh_sizes(rows: Refinement) -> list[float]:
    return [1.0 / run.elements for run in rows.meshes]


def _steps(rows: Refinement) -> list[float]:
    return [run.step for run in rows.steps]


def _nearest_step(rows: Refinement, declaration: Declaration) -> tuple[int, float]:
    """Return which of the steps is nearest to the meshes', and by how much its error grows."""
    steps, wanted = _steps(rows), rows.meshes[-1].step
    number = int(np.argmin(np.abs(np.log(np.array(steps) / wanted))))
    return number, float((wanted / steps[number]) ** (declaration.order_in_step or 1.0))


def _both(mesh: Convergence, step: Convergence | None, **found: Any) -> Convergence:
    """Return the convergence in the mesh with both its uncertainty and the step's."""
    if step is None:
        return replace(mesh, **found)
    settles = mesh.settles and step.settles
    why = mesh.why if step.settles else step.why
    return replace(mesh, bar=mesh.bar + step.bar, settles=settles, why=why, **found)
