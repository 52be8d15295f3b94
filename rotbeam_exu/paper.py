"""Choices of the paper: speeds, ramp times, models, and the line of each model."""

from __future__ import annotations

from typing import Any

SPEEDS = (2.0, 4.0, 6.0, 8.0)
"""Angular velocities of Secs. 5 and 6 [rad/s]."""

RAMP_TIMES = (3.375, 3.25, 3.0, 2.75, 2.5, 2.0)
"""Ramp times of Sec. 6 [s]."""

MODELS = ("CI", "CE", "FrI", "FrE", "FrC", "FrM")
"""Reduced models drawn beside the exact backbone: the paper's four, and ours."""

MODEL_NAMES = {
    "CI": "cantilever's mode, inextensible",
    "CE": "cantilever's mode, extensible",
    "FrI": "rotating mode, inextensible",
    "FrE": "rotating mode, extensible",
    "FrC": "rotating mode, consistent foreshortening",
    "FrM": "FrC with all other bending modes",
    "exact": "geometrically exact beam",
}
"""The models in words."""

# Okabe and Ito's palette (2008), which the color blind can tell apart; black is for the exact beam.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#CC79A7",
    "#56B4E9",
)

MODEL_LINES: dict[str, dict[str, Any]] = {
    "CI": {"color": RED, "ls": (0, (1, 1))},
    "CE": {"color": PURPLE, "ls": (0, (3, 1))},
    "FrI": {"color": ORANGE, "ls": (0, (5, 1, 1, 1))},
    "FrE": {"color": GREEN, "ls": "--"},
    "FrC": {"color": SKY, "ls": (0, (4, 1, 1, 1, 1, 1))},
    "FrM": {"color": BLUE, "ls": "-"},
    "exact": {"color": "black", "ls": "-", "lw": 0.7},
}
"""One line per model in every figure; black is the exact beam."""
