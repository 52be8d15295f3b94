"""How exact answers change with the numbers of a blade: derivatives by the answer's own tangent."""

from .derivatives import Sensitivity, sensitivity
from .fitting import fit
from .least_squares import Fit
from .measured import Measured, MeasuredFrequency, MeasuredMotion, MeasuredState
from .parameters import Parameter, parameters_of
from .samples import sampled
from .scatter import Spread, campbell_spread, spread

__all__ = [
    "Fit", "Measured", "MeasuredFrequency", "MeasuredMotion", "MeasuredState", "Parameter",
    "Sensitivity", "Spread", "campbell_spread", "fit", "parameters_of", "sampled", "sensitivity",
    "spread",
]  # fmt: skip
