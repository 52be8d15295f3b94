"""How exact answers change with the numbers of a blade: derivatives by the answer's own tangent."""

from .derivatives import Sensitivity, sensitivity
from .fitting import Fit, fit
from .measured import Measured, MeasuredFrequency, MeasuredState
from .parameters import Parameter, parameters_of
from .scatter import Spread, campbell_spread, sampled, spread

__all__ = [
    "Fit", "Measured", "MeasuredFrequency", "MeasuredState", "Parameter", "Sensitivity", "Spread",
    "campbell_spread", "fit", "parameters_of", "sampled", "sensitivity", "spread",
]  # fmt: skip
