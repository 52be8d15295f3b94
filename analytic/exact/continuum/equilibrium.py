"""The steady state of a blade at a constant rate, followed from rest by Newton's method."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray
from ...methods.system import Tangent
from .state import Driven

_SHORTEST = 1e-4  # step of speed and load, over what of them is reached
_STEPS = 60  # of speed and load
_CHANGES, _EXACT = 12, 1e-12  # of Newton's method, and the last over the size of the state
_CONTRACTION = 0.25
_NEAR = 1e-3  # change over the size of the state, from which on the tangent serves


class Equilibrium(NamedTuple):
    """A discretization in steady rotation under loads."""

    model: Any  # a `Model`
    by: Driven

    @property
    def _loaded(self) -> bool:
        return self.by.push is not None or bool(self.by.follow)

    def followed(self, near: FloatArray | None) -> tuple[FloatArray, Tangent]:
        """Return coordinates (n,) and tangent of the state near these, or followed from rest.

        Raises
        ------
        ValueError
            If the state ends, or gets unstable, before speed and load are reached.
        """
        state = None if near is None else self._newton(near, 1.0)
        if state is not None:
            return state
        # A straight blade stays straight, and nothing is to be followed.
        still = not self._loaded and (self.by.rate == 0.0 or self.model.uncoupled)
        q, reached, step = np.zeros(self.model.size), float(still), 1.0
        for _ in range(_STEPS):
            share = min(reached + step, 1.0)
            state = self._newton(q, share)
            if state is not None:
                if share == 1.0:
                    return state
                q, reached, step = state[0], share, 2.0 * step
            else:
                step = 0.5 * (share - reached)
                if step <= _SHORTEST * reached:
                    raise ValueError(self._lost("ends or becomes unstable", reached))
        raise ValueError(self._lost(f"is followed in {_STEPS} steps and is still", reached))

    def _lost(self, how: str, reached: float) -> str:
        """Return a sentence on the steady state that is followed up to shares of speed and load."""
        at, remedies = [], []
        if self.by.rate:
            at.append(f"w_bar = {reached * self.by.rate:.4g} of {self.by.rate:.4g}")
            remedies.append("rotate slower")
        if self._loaded:
            at.append(f"{reached:.4g} of the load")
            remedies.append("load it less, and check its unit")
        return f"the steady state {how} at {' and '.join(at)}: {', or '.join(remedies)}"

    def _newton(self, q: FloatArray, share: float) -> tuple[FloatArray, Tangent] | None:
        """Return the state that `q` (n,) goes over into at shares of speed and load; its tangent.

        None where it may be one of another branch: the tangent must stay stable, and the second
        change be less than a quarter of the first, as it is where the theorem of Newton and
        Kantorovich holds (Deuflhard, Newton Methods for Nonlinear Problems, 2011).
        """
        still, by = np.zeros((1, self.model.size)), self.by.share(share)
        turned = bool(by.follow) or (by.push is not None and by.push.ndim > 2 and by.push[2].any())
        sizes: list[float] = []
        for _ in range(_CHANGES):
            near = self.model.has_dear_tangent and bool(sizes)
            near = near and sizes[-1] <= _NEAR * float(np.linalg.norm(q))
            if near:
                residual = self.model.residual(q[None], still, still, by)[0]
            else:
                tangent = self.model.tangent(q[None], still, still, by)
                residual = tangent.residual[0]
                if not _positive(tangent.stiffness[0], symmetric=not turned):
                    return None
            change = np.linalg.solve(tangent.stiffness[0], residual)
            q = q - change
            sizes.append(float(np.linalg.norm(change)))
            if sizes[-1] <= _EXACT * max(float(np.linalg.norm(q)), _EXACT):
                return q, self.model.tangent(q[None], still, still, by) if near else tangent
            if len(sizes) == 2 and not sizes[1] <= _CONTRACTION * sizes[0]:
                return None
        return None


def _positive(stiffness: FloatArray, *, symmetric: bool) -> bool:
    """Whether a state is stable; what follows, and a moment that does not, have no potential."""
    if not symmetric:
        return bool(np.linalg.eigvals(stiffness).real.min() > 0.0)
    try:
        np.linalg.cholesky(stiffness)
    except np.linalg.LinAlgError:
        return False
    return True
