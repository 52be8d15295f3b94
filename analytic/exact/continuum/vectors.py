"""Vector fields with the three components first: cross products, rotations, quaternions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...arrays import ComplexArray, FloatArray
from ...quadrature import Running

_PICARD, _SETTLED = 40, 2e-15  # iterations at most, and the change after which the next is less
_WOUND = 4.0  # ∫|K|dx of a stretch


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a × b of fields (3, ...), which broadcast."""
    result = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[j], b[k], out=result[i])
        result[i] -= a[k] * b[j]
    return result


def turned(frame: FloatArray, vector: FloatArray) -> FloatArray:
    """Return R y for frames (3, 3, ...) and vectors (3, ...)."""
    result = np.empty((3, *np.broadcast_shapes(frame.shape[2:], vector.shape[1:])))
    for i, row in enumerate(frame):
        np.multiply(row[0], vector[0], out=result[i])
        result[i] += row[1] * vector[1]
        result[i] += row[2] * vector[2]
    return result


def turned_back(frame: FloatArray, vector: FloatArray) -> FloatArray:
    """Return Rᵀ y for frames (3, 3, ...) and vectors (3, ...)."""
    return turned(np.swapaxes(frame, 0, 1), vector)


def about_axis(angle: FloatArray) -> FloatArray:
    """Return the rotations (3, 3, ...) about the first axis by angles (...)."""
    c, s, one, none = np.cos(angle), np.sin(angle), np.ones_like(angle), np.zeros_like(angle)
    return np.stack([np.stack(row) for row in ((one, none, none), (none, c, -s), (none, s, c))])


def product(p: FloatArray, q: FloatArray) -> FloatArray:
    """Return the quaternions p ∘ q, each (4, ...)."""
    real = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3]
    return np.concatenate((real[None], p[0] * q[1:] + q[0] * p[1:] + cross(p[1:], q[1:])))


def frames(quaternion: FloatArray) -> FloatArray:
    """Return the rotations (3, 3, ...) of quaternions (4, ...) of any size."""
    a, b, c, d = quaternion / np.sqrt(np.sum(quaternion * quaternion, axis=0))
    return np.stack(
        [
            np.stack(row)
            for row in (
                (1.0 - 2.0 * (c * c + d * d), 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)),
                (2.0 * (b * c + a * d), 1.0 - 2.0 * (b * b + d * d), 2.0 * (c * d - a * b)),
                (2.0 * (b * d - a * c), 2.0 * (c * d + a * b), 1.0 - 2.0 * (b * b + c * c)),
            )
        ]
    )


class Frames:
    """Solution of R' = R K̂, R(0) = 1, at a grid's points and at further places.

    Unit quaternions obey Q' = ½ Q ∘ (0, K): collocation at the Gauss points of each stretch, and
    the product of the stretches before.

    Parameters
    ----------
    running : Running
        To the points of the grid first, and to the places; its stretches end at the kinks.
    kinks : list
        Material points, and rotation vectors (3,) by which the frame jumps there, one by one.
    """

    def __init__(self, running: Running, kinks: Sequence[tuple[float, FloatArray]] = ()) -> None:
        parts = running.stretches
        self._count, self._stretches = running.count, len(parts)
        ends = np.cumsum([part.weights.sum() for part in parts])
        self._kinks: dict[int, FloatArray] = {}
        for x, vector in kinks:
            place, turn = int(np.argmin(np.abs(ends - x))), _quaternion(vector)
            before = self._kinks.get(place)
            self._kinks[place] = turn if before is None else product(before, turn)
        # Stretches with as many points and places go together, their ends behind their places.
        self._together = []
        for shape in {part.onto.shape for part in parts}:
            which = [k for k, part in enumerate(parts) if part.onto.shape == shape]
            points, places, onto = zip(
                *(
                    (np.r_[one.own], np.r_[one.places], np.column_stack((one.onto, one.weights)))
                    for one in (parts[k] for k in which)
                ),
                strict=True,
            )
            self._together.append(
                (np.array(which), np.array(points), np.array(places), np.array(onto))
            )

    def of(self, curvature: FloatArray) -> FloatArray:
        """Return R at the points and the places, (3, 3, samples, points and places).

        From curvatures (3, samples, points) in the moving frame.
        """
        samples = curvature.shape[1]
        begins = np.zeros((4, self._stretches + 1, samples))
        begins[0, 0] = 1.0
        alone = []
        for which, points, _, onto in self._together:
            alone.append(_from_unit(np.swapaxes(curvature[:, :, points], 1, 2), onto))
            begins[:, which + 1] = alone[-1][..., -1]
        for k, turn in self._kinks.items():
            begins[:, k + 1] = product(begins[:, k + 1], turn)
        # Products of all before, of twice as many each time.
        reach = 1
        while reach <= self._stretches:
            begins[:, reach:] = product(begins[:, :-reach], begins[:, reach:])
            reach *= 2
        quaternions = np.empty((4, samples, self._count))
        for (which, _, places, _), local in zip(self._together, alone, strict=True):
            here = product(begins[:, which, :, None], local[..., :-1])
            quaternions[:, :, places] = np.swapaxes(here, 1, 2)
        return frames(quaternions)


def _quaternion(vector: FloatArray) -> FloatArray:
    """Return the quaternion (4, 1) of a rotation vector (3,)."""
    half = 0.5 * float(np.linalg.norm(vector))
    # sin(x)/x, of numpy in units of π.
    return np.array([math.cos(half), *(0.5 * np.sinc(half / math.pi) * vector)])[:, None]


def _from_unit(curvature: FloatArray, integral: FloatArray) -> FloatArray:
    """Return Q (4, stretches, samples, places) that starts at 1, by collocation on each stretch.

    As u + vj with complex u and v. Picard's iteration finds the collocated solution itself: on one
    stretch its errors fall as the terms of exp(|K|/2). Beyond a turn or so round-off grows as that.
    """
    k1, k2, k3 = 0.5 * curvature
    turn, bend, onto = 1j * k1, k2 + 1j * k3, integral.astype(np.complex128)
    back, count = bend.conj(), onto.shape[1]
    solution = np.zeros((2, *k1.shape), dtype=np.complex128)
    solution[0] = 1.0

    def rates(of: ComplexArray) -> ComplexArray:
        u, v = of
        return np.stack((u * turn - v * back, u * bend - v * turn))

    if (np.sqrt(np.sum(curvature**2, axis=0)) @ integral[..., -1:]).max(initial=0.0) > _WOUND:
        inside = np.swapaxes(integral[..., :count], 1, 2)[:, None]
        parts = [[turn, -back], [bend, -turn]]
        system = np.block([[-one[..., None, :] * inside for one in row] for row in parts])
        system += np.eye(2 * count)
        begin = np.repeat([1.0, 0.0], count)[:, None]
        solved = np.linalg.solve(system, np.broadcast_to(begin, (*k1.shape[:2], 2 * count, 1)))
        solution = np.moveaxis(solved.reshape(*k1.shape[:2], 2, count), 2, 0)
    else:
        for _ in range(_PICARD):
            last, solution = solution, rates(solution) @ onto[..., :count]
            solution[0] += 1.0
            if np.abs(solution - last).max(initial=0.0) < _SETTLED:
                break
    u, v = rates(solution) @ onto
    return np.stack((1.0 + u.real, u.imag, v.real, v.imag))


def rotation_vectors(turns: FloatArray) -> FloatArray:
    """Return the rotation vectors (..., 3) of rotations (..., 3, 3) by less than half a turn."""
    across = 0.5 * np.stack(
        [turns[..., k - 1, k - 2] - turns[..., k - 2, k - 1] for k in range(3)], axis=-1
    )
    sine = np.linalg.norm(across, axis=-1, keepdims=True)
    angle = np.arctan2(sine, 0.5 * (np.trace(turns, axis1=-2, axis2=-1)[..., None] - 1.0))
    return np.asarray(across * np.where(sine > 0.0, angle / np.where(sine > 0.0, sine, 1.0), 1.0))
