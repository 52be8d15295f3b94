"""A run, whoever computed it: its checks, its steady oscillation. Knows no Exudyn."""

from typing import Literal

Frame = Literal["inertial", "rotating"]
"""The coordinates of a model."""

Element = Literal[
    "cable", "exact", "ancf3", "linear", "substructures", "space_cable", "space_exact"
]
"""The formulations that a file may name; a user's class is for the command line alone."""
