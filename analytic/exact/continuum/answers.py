"""Functions made of the forces that answers on fewer functions cause.

Where a table has kinks or centers that jump, forces are no polynomials. But the strains S⁻¹F under
the forces F of an answer, integrals of all beyond, are nearer to the exact ones than its own, with
the kinks of the section where they are (iterated Galerkin: Sloan, Math. Comp. 30, 1976). Taken for
further functions they leave an error in frequencies a thousand times smaller, again and again.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...quadrature import Grid

_SMALL = 1e-4  # size of a vibration, in which forces are linear
_SEEN = 1e-6  # part of a strain that others lack: frequencies feel its square
_TURNED, _REFLECTED = (1, 2, 4, 5), (1, 3, 5)  # components that half turn and mirror turn around


@dataclass(frozen=True, eq=False)
class Answers:
    """Forces from which functions are made besides polynomials, in the frame without twist."""

    grid: Grid
    forces: FloatArray  # (points, 6, count)
    odd: NDArray[np.bool_]  # whether half turn and mirror turn them around, (2, count)
    reach: tuple[int, ...]  # numbers of polynomials that they make up for

    @property
    def count(self) -> int:
        """Number of functions."""
        return int(self.forces.shape[2])

    def at(self, x: FloatArray) -> FloatArray:
        """Return the forces at `x`, (places, 6, count)."""
        if x is self.grid.points:
            return self.forces
        return _at(x, self.grid, self.forces)


def forces_caused(steady: Any, count: int) -> FloatArray:
    """Return the forces of a `SpaceBlade`'s steady state and lowest modes, (points, 6, functions).

    Those of the modes at the phases of both parts of their shapes, each of unit elastic energy.
    """
    model, by, q = steady.model, steady.by(), steady.equilibrium
    still = np.zeros((1, q.size))
    parts: list[FloatArray] = [model.forces_caused(q[None], still, still, by)]
    if not count:
        return parts[0]
    frequencies, shapes = (part[..., :count] for part in steady.vibration)
    size = np.einsum("ik,ij,jk->k", shapes.conj(), model.functions.stiffness, shapes).real
    for phase in (1.0, 1.0j):
        moved: ComplexArray = _SMALL * phase * (shapes / np.sqrt(size)).T
        rates = 1j * frequencies[:, None] * moved
        one, other = (
            model.forces_caused(
                q + sign * moved.real,
                sign * rates.real,
                -sign * np.square(frequencies)[:, None] * moved.real,
                by,
            )
            for sign in (1.0, -1.0)
        )
        parts.append(0.5 * (one - other) / _SMALL)
    return np.concatenate(parts, axis=2)


def beside(functions: Any, caused: FloatArray | None, seen: float | None = None) -> Answers:
    """Return what `StrainFunctions` are made of besides first polynomials, on a finer grid.

    Answers so far; polynomials of higher degrees, a third more; and the forces caused, (points, 6,
    count), of answers on the functions. All but the first are orthonormal in flexibility to those
    before. Strains that differ from theirs by less than 1e-6 are left out; where `seen` is given
    those by less than it, and polynomials, of which a motion lacks none. Components that go without
    others make functions of their own.
    """
    unit, before = functions.blade, functions.reach
    reach = tuple(n + max(n // 3, 1) for n in before)
    bending, torsion, axial = reach
    higher = replace(functions, bending=bending, torsion=torsion, axial=axial, answers=None)
    grid = higher.grid
    x = grid.points
    added = [higher.forces(x)] if seen is None else []
    if caused is not None:
        added.append(_at(x, functions.grid, caused))
    sets = [set(range(6))]
    for there, turned in ((unit.half_turn, _TURNED), (unit.mirrored, _REFLECTED)):
        if there:
            sets = [part for one in sets for part in (one & {*turned}, one - {*turned})]
    soft = grid.weights[:, None, None] * functions.flexibility(x)
    known = functions.forces(x)
    stiffness = _work(known, soft @ known)
    parts = [known[..., sum(functions.counts) :]]
    odd = [np.empty((2, 0), dtype=bool) if functions.answers is None else functions.answers.odd]
    for forces in added:
        new = []
        for rows in map(sorted, sets):
            part = np.zeros_like(forces)
            part[:, rows] = forces[:, rows]
            for _ in range(2):  # the second time against round-off
                part = part - known @ np.linalg.solve(stiffness, _work(known, soft @ part))
            sizes, turns = np.linalg.eigh(_work(part, soft @ part))
            kept = sizes > (seen or _SEEN) ** 2
            new.append(part @ (turns[:, kept] / np.sqrt(sizes[kept])))
            odd.append(np.tile([[rows[0] in _TURNED], [rows[0] in _REFLECTED]], kept.sum()))
        parts += new
        known = np.concatenate((known, *new), axis=2)
        stiffness = _work(known, soft @ known)
    return Answers(grid, np.concatenate(parts, axis=2), np.concatenate(odd, axis=1), reach)


def _work(forces: FloatArray, strains: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("pik,pil->kl", forces, strains, optimize=True))


def _at(x: FloatArray, grid: Grid, forces: FloatArray) -> FloatArray:
    """Return forces (places, 6, count) at `x`, polynomials on each cell of a grid."""
    flat = grid.interpolation(x) @ forces.reshape(len(forces), -1)
    return np.asarray(flat).reshape(x.size, 6, -1)
