"""Derivatives of a reduced model's numbers: they are closed forms, of which differences are taken.

Of a blade whose functions are integrals along it, too; four models a parameter, each in
milliseconds.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..motion import SteadyRotation
from ..reduced.model import ReducedModel
from ..reduced.model_range import model_at
from .conditions import conditions_of
from .energies import FINE, OneByOne, difference
from .parameters import Parameter, parameters_of

_CHANGE = 1e-3  # of a parameter over its size, of which the fourth power is left
_UNIFORM = "EA", "EI3", "m"  # with any of which a beam is still the paper's kind
_NUMBERS = {"omega_n": "rad/s", "lambda_omega": "1", "lambda_x": "1", "kappa": "1"}


class ModelDerivatives(OneByOne):
    """Derivatives of ω_n, λ_ω, λ_x and κ."""

    outputs, units = tuple(_NUMBERS), tuple(_NUMBERS.values())

    def __init__(self, model: ReducedModel) -> None:
        self._model, self.values = model, _numbers(model)
        known = parameters_of(model.blade, model.theory)
        if not model.variant.is_of_any_blade:
            known = {name: one for name, one in known.items() if name in _UNIFORM}
        self.parameters = known
        self.conditions = conditions_of(
            SteadyRotation(omega=model.omega), unit=model.blade.frequency_scale
        )

    def to(self, parameter: Parameter) -> FloatArray:
        """Return the derivatives of all numbers to a parameter."""
        return difference(parameter, self._anew, _CHANGE, FINE)

    def _anew(self, other: Any) -> FloatArray:
        model = self._model
        if isinstance(other, Blade):
            return _numbers(model_at(other, model.omega, model.variant))
        return _numbers(model_at(model.blade, other[0].omega, model.variant))


def _numbers(model: ReducedModel) -> FloatArray:
    return np.array([getattr(model, name) for name in _NUMBERS])
