"""The coordinates of a model."""

from typing import Literal

Frame = Literal["inertial", "rotating"]
