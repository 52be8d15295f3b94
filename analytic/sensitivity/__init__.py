"""How exact answers change with the numbers of a blade: derivatives by the answer's own tangent."""

from .frequencies import Sensitivity, sensitivity
from .parameters import Parameter, parameters_of

__all__ = ["Parameter", "Sensitivity", "parameters_of", "sensitivity"]
