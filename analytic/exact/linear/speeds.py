"""The blade in steady rotation over a range of speeds, out of few of them, and its modes there.

Its steady state, stiffness, mass and Coriolis forces over the speed are analytic in its square, and
smooth also where modes veer, as frequencies are not. So few speeds determine all that lie between.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray
from ...lazily import linalg, optimize
from ...methods.system import Tangent
from ...settled import ROUND_OFF, judged
from ..continuum.rotation import SteadyBlade

_MOST = 40  # speeds that are solved
_PLACES = np.append(0.0, np.geomspace(1e-7, 1.0, 1024))  # in the range of w̄², to choose from
_SURE, _HALVINGS = 0.7, 6  # of the criterion of modes that are followed; of steps below it


class Stop(NamedTuple):
    """Modes that are followed, at one speed."""

    steady: SteadyBlade
    places: NDArray[np.intp]  # in ascending order of all frequencies
    assurance: FloatArray  # modal assurance criterion of each, from the stop before


class Solved(NamedTuple):
    """The blade at one speed; stiffness, Coriolis forces over the speed, and mass, (3, n, n)."""

    steady: SteadyBlade
    matrices: FloatArray


def _solved(steady: SteadyBlade) -> Solved:
    _, K, C, M = (part[0] for part in steady.linearized)
    if steady.rate == 0.0:
        # Coriolis forces are in proportion to the speed, and those at rest the limit.
        still, turning = np.zeros((1, steady.size)), replace(steady, rate=1.0)
        C = turning.tangent(steady.equilibrium[None], still, still).damping[0]
    return Solved(steady, np.array([K, 0.5 * (C - C.T) / (steady.rate or 1.0), M]))


@dataclass(frozen=True, eq=False)
class SpeedRange:
    """Steady states at some speeds, and those between them by polynomials.

    Of a blade that stays straight they are in w̄². Others straighten at speeds near their lowest
    frequency w̄_1 at rest, and have singularities at w̄² < 0 of that size. The polynomials of theirs
    are in ln(1 + w̄²/w̄_1²), which keeps away from these.
    """

    solved: tuple[Solved, ...]

    @cached_property
    def _squares(self) -> FloatArray:
        return np.array([one.steady.rate**2 for one in self.solved])

    @cached_property
    def _states(self) -> FloatArray:
        return np.array([one.steady.equilibrium for one in self.solved])

    @cached_property
    def _matrices(self) -> FloatArray:
        return np.array([one.matrices for one in self.solved])

    def _variable(self, squares: FloatArray) -> FloatArray:
        first = self.solved[0].steady
        straight = first.model.uncoupled
        return squares if straight else np.log1p(squares / first.vibration[0][0] ** 2)

    def at(self, rate: float) -> SteadyBlade:
        """Return the blade at a rate, its state and tangent interpolated."""
        known, at = map(self._variable, (self._squares, np.array(rate**2)))
        others = [np.delete(known, k) for k in range(known.size)]
        apart = zip(known, others, strict=True)
        shares = np.array([np.prod((at - other) / (one - other)) for one, other in apart])
        K, G, M = np.tensordot(shares, self._matrices, 1)[:, None]
        q = shares @ self._states
        given = q, Tangent(np.zeros((1, q.size)), K, rate * G, M)
        return replace(self.solved[0].steady, rate=rate, given=given)

    def farther(self) -> tuple[SpeedRange, SteadyBlade, SteadyBlade]:
        """Return it with one more speed, and the blade there, interpolated before and solved.

        Speeds are Leja's: the next is where the polynomial with zeros at all so far is largest.
        """
        squares = self._squares[0] + _PLACES * (self._squares[1] - self._squares[0])
        known, places = map(self._variable, (self._squares, squares))
        far = np.prod(np.abs(places[:, None] - known) / np.ptp(known), axis=1)
        guess = self.at(math.sqrt(squares[np.argmax(far)]))
        steady = replace(guess, near=guess.equilibrium, given=None)
        return SpeedRange((*self.solved, _solved(steady))), guess, steady

    def way(self, rates: FloatArray, places: Sequence[int]) -> list[list[Stop]]:
        """Return the stops on the way to each rate, of modes in these places at the first."""
        at = Stop(self.at(float(rates[0])), np.array(places), np.ones(len(places)))
        ways = [[at]]
        for rate in rates[1:].tolist():
            ways.append(self._followed(ways[-1][-1], rate))
        return ways

    def _followed(self, before: Stop, rate: float, left: int = _HALVINGS) -> list[Stop]:
        """Return the stops on the way to a rate, which is halved where shapes change much."""
        steady = self.at(rate)
        places, sure = followed(before.steady, steady, before.places)
        if left and sure.min() < _SURE:
            middle = math.sqrt(0.5 * (before.steady.rate**2 + rate**2))
            way = self._followed(before, middle, left - 1)
            return way + self._followed(way[-1], rate, left - 1)
        return [Stop(steady, places, sure)]

    def crossings(self, before: Stop, after: Stop, orders: int) -> Iterator[tuple[int, int, float]]:
        """Yield column, k and rate where frequencies of modes followed cross k w̄ between two stops.

        In ascending order frequencies are continuous. A mode followed by its shape changes its
        place at once where two veer, and passes a line in between without being there. So many
        modes are below the line as the dynamic stiffness at k w̄ has negative eigenvalues.
        """
        first, last = before.steady, after.steady
        places = np.union1d(before.places, after.places).tolist()
        for at in product(places, range(1, orders + 1)):
            place, order = at
            off = {
                one.rate**2: float(one.vibration[0][place]) - order * one.rate
                for one in (first, last)
            }
            low, high = off.values()
            if low > 0.0 >= high or low < 0.0 <= high:
                square = optimize.toms748(
                    self._past_line, first.rate**2, last.rate**2, args=(off, *at),
                    xtol=1e-13 * last.rate**2, rtol=1e-13,
                )  # fmt: skip
                held = np.argmax(_assurance(first, self._softest(square, *at)[1]))
                for column in np.flatnonzero(before.places == held).tolist():
                    yield column, order, math.sqrt(square)

    def _past_line(self, square: float, known: dict[float, float], *at: int) -> float:
        return known[square] if square in known else self._softest(square, *at)[0]

    def _softest(self, square: float, place: int, order: int) -> tuple[float, NDArray[Any]]:
        """Return the eigenvalue in one place of the dynamic stiffness at k w̄, and its shape."""
        steady = self.at(math.sqrt(square))
        whole = steady.dynamic_stiffness(order * steady.rate)
        (value,), shape = linalg.eigh(whole, subset_by_index=(place, place))
        return float(value), shape


def range_between(
    ends: Sequence[SteadyBlade], modes: int, tolerance: float, what: str
) -> tuple[SpeedRange, float]:
    """Return all speeds between two, and the largest relative error of frequencies seen.

    It is that of the lowest `modes` at the speed added last, which the others predicted.
    """
    found, last = SpeedRange(tuple(map(_solved, ends))), math.inf
    change = math.inf if len(ends) > 1 else 0.0
    while change > tolerance and len(found.solved) < _MOST:
        found, guess, steady = found.farther()
        last = change
        try:
            told, known = (one.vibration[0][:modes] for one in (guess, steady))
            change = float(np.max(np.abs(np.log(told / known))))
        except np.linalg.LinAlgError:  # so few speeds tell no stiffness
            change = math.inf
        if last <= 2.0 * change <= ROUND_OFF:
            break
    judged(change, tolerance, what, "ask for a smaller range of speeds")
    return found, change


def followed(
    before: SteadyBlade, steady: SteadyBlade, places: NDArray[np.intp]
) -> tuple[NDArray[np.intp], FloatArray]:
    """Return the places of modes at another speed, and the modal assurance criterion of each."""
    criterion = _assurance(before, steady.vibration[1])[places]
    rows, columns = optimize.linear_sum_assignment(-criterion)
    return columns, criterion[rows, columns]


def _assurance(steady: SteadyBlade, others: NDArray[Any]) -> FloatArray:
    """Return the modal assurance criterion of all modes with shapes (n, count).

    In the energy norm of the blade at rest.
    """
    a, b = (part / np.linalg.norm(part, axis=0) for part in (steady.vibration[1], others))
    return np.asarray(np.abs(a.conj().T @ b) ** 2)
