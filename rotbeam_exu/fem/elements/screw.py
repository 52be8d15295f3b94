"""The screw from one frame to another: strains of an element in space, and forces on its ends."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np

from analytic.arrays import FloatArray

from .node_kinds import cross, directors, onto_parameters


class Screw(NamedTuple):
    """The screws of elements whose ends carry r and Euler parameters p, (..., elements, n).

    The logarithm in SE(3) is u = d - ψ×d/2 + b ψ×(ψ×d) and ψ, b = [1 - (ψ/2) cot(ψ/2)]/ψ².

    Attributes
    ----------
    p, turn : ndarray
        Euler parameters and frames of both ends, (..., 2, 4) and (..., 2, 3, 3).
    d, psi : ndarray
        Distance of the ends, and rotation between them, in the first frame.
    bent, change : ndarray
        b and b'/ψ, (..., 1).
    """

    p: FloatArray
    turn: FloatArray
    d: FloatArray
    psi: FloatArray
    bent: FloatArray
    change: FloatArray

    @classmethod
    def of(cls, e: FloatArray) -> Self:
        """Return the screws of coordinates (..., elements, 14)."""
        q = e.reshape(*e.shape[:-1], 2, 7)
        turn, p = directors(q[..., 3:]), q[..., 3:]
        d = times(np.swapaxes(turn[..., 0, :, :], -1, -2), q[..., 1, :3] - q[..., 0, :3])
        (a, u), (b, v) = ((p[..., i, :1], p[..., i, 1:]) for i in (0, 1))
        cosine, sine = a * b + _dot(u, v), a * v - b * u - cross(u, v)
        sine = np.where(cosine < 0.0, -sine, sine)  # of p and -p the rotation is the same
        size = np.maximum(np.sqrt(_dot(sine, sine)), 1e-300)
        psi = 2.0 * np.arctan2(size, np.abs(cosine)) / size * sine
        square = _dot(psi, psi)
        # Of their series: below 1e-2 the rest is 1e-13 of b, and 1e-8 of its change.
        angle = np.sqrt(np.maximum(square, 1e-4))
        half = 0.5 * angle
        bent = (1.0 - half / np.tan(half)) / angle**2
        change = ((half / np.sin(half)) ** 2 + half / np.tan(half) - 2.0) / angle**4
        small = square < 1e-4
        return cls(
            p, turn, d, psi, np.where(small, (1.0 + square / 60.0) / 12.0, bent),
            np.where(small, 1.0 / 360.0 + square / 7560.0, change),
        )  # fmt: skip

    @property
    def logarithm(self) -> FloatArray:
        """The vectors u and ψ as one, (..., elements, 6)."""
        across = cross(self.psi, self.d)
        u = self.d - 0.5 * across + self.bent * cross(self.psi, across)
        return np.concatenate((u, self.psi), axis=-1)

    def onto_ends(self, stress: FloatArray) -> FloatArray:
        """Return the forces (..., elements, 14) on both ends of stresses (..., elements, 6)."""
        p, turn, d, psi, bent, change = self
        n, m = stress[..., :3], stress[..., 3:]
        once = cross(psi, n)
        twice = cross(psi, once)
        force = n + 0.5 * once + bent * twice
        m = m - 0.5 * cross(d, n) + change * _dot(twice, d) * psi
        m = m + bent * (_dot(psi, d) * n + _dot(psi, n) * d - 2.0 * _dot(d, n) * psi)
        once = cross(psi, m)
        end = m - 0.5 * once + bent * cross(psi, once)
        start = cross(force, d)
        start -= times(np.swapaxes(turn[..., 0, :, :], -1, -2), times(turn[..., 1, :, :], end))
        along = times(turn[..., 0, :, :], force)
        torques = onto_parameters(p, np.stack((start, end), axis=-2))
        both = np.concatenate((np.stack((-along, along), axis=-2), torques), axis=-1)
        return both.reshape(*both.shape[:-2], 14)

    def slopes(self) -> FloatArray:
        """Return the derivatives of the logarithm by the coordinates, (..., elements, 6, 14)."""
        units = np.eye(6).reshape(6, *(self.psi.ndim - 1) * [1], 6)
        return np.moveaxis(self.onto_ends(units), 0, -2)


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a · b of vectors (..., 3), (..., 1)."""
    return np.asarray(np.einsum("...i,...i->...", a, b)[..., None])


def times(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Return matrices (..., n, m) times vectors (..., m)."""
    return np.asarray((matrix @ vector[..., None])[..., 0])
