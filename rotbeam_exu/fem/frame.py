"""The coordinates of a model."""

from __future__ import annotations

from typing import Literal

from analytic import AnyBlade

Frame = Literal["inertial", "rotating"]


def require_frame(beam: AnyBlade, frame: Frame) -> None:
    """Refuse a frame that is not known, or in which the blade is not modeled."""
    if frame not in ("inertial", "rotating"):
        raise ValueError(f"unknown frame {frame!r}; known are 'inertial' and 'rotating'")
    if frame == "inertial" and beam.unit.setting != 1.0:
        raise ValueError(
            "in the inertial frame the models turn in their plane of bending, and this blade has a "
            f"setting angle with the cosine {beam.unit.setting:.4g}: take frame='rotating'"
        )
