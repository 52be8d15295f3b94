"""How exact answers change with the numbers of a blade: derivatives by the answer's own tangent."""

from .derivatives import Sensitivity, sensitivity
from .parameters import Parameter, parameters_of
from .scatter import Spread, sampled, spread

__all__ = [
    "Parameter", "Sensitivity", "Spread", "parameters_of", "sampled", "sensitivity", "spread",
]  # fmt: skip
