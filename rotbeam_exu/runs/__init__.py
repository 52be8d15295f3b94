"""A run, whoever computed it: its checks, its steady oscillation. Knows no Exudyn."""

from typing import Literal

Frame = Literal["inertial", "rotating"]
"""The coordinates of a model."""
