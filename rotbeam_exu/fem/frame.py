"""The coordinates of a model."""

from __future__ import annotations

from typing import Literal

Frame = Literal["inertial", "rotating"]


def require_frame(setting: float, frame: Frame) -> None:
    """Refuse a frame that is not known, or in which a blade of that setting is not modeled."""
    if frame not in ("inertial", "rotating"):
        raise ValueError(f"unknown frame {frame!r}; known are 'inertial' and 'rotating'")
    if frame == "inertial" and setting != 1.0:
        raise ValueError(
            "in the inertial frame the models turn in their plane of bending, and this blade has a "
            f"setting angle with the cosine {setting:.4g}: take frame='rotating'"
        )
