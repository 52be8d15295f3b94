"""One run: all that determines its result, checked before anything is computed."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from analytic import Blade, SteadyRotation
from analytic.description import describe, from_description
from analytic.exact.continuum.loading import loaded
from analytic.input_checks import positive, whole_number
from analytic.loads import Load, loads_in_time, rippled
from analytic.motion import Rotation, SpeedChange

from ..runs import Frame
from ..runs.attributes import (
    beam_of,
    blade_attributes,
    loads_attributes,
    loads_of,
    motion_attributes,
    motion_of,
)
from ..runs.check import checked_steps
from .elements import Formulation, formulation, require_modeled


@dataclass(frozen=True, kw_only=True)
class RunCase:
    """One run of the beam: the only place where one is validated and its element looked up.

    Fields are as in `simulate`; a name becomes the formulation, NumPy's numbers become Python's.
    """

    blade: Blade
    spin_up: SpeedChange | SteadyRotation
    element: str | Formulation = "cable"
    elements: int = 16
    duration: float = 15.0
    step: float = 1e-3
    frame: Frame = "inertial"
    loads: Sequence[Load] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.spin_up, SpeedChange | SteadyRotation):
            raise TypeError(
                "spin_up must be a SpinUp, a FourierRamp, a SpeedTable, another SpeedChange or a "
                f"SteadyRotation, got {self.spin_up!r}; a ripple of it is one of the loads"
            )
        for name, value in (
            ("element", formulation(self.element)),
            ("elements", whole_number("elements", self.elements)),
            ("duration", positive("duration", self.duration, "s")),
            ("step", positive("step", self.step, "s")),
            ("loads", loads_in_time(self.loads)),
        ):
            object.__setattr__(self, name, value)
        require_modeled(self.blade, self.model, self.frame)
        if not self.model.leaves_plane and any(load.leaves_plane for load in self.loads):
            raise ValueError(
                f"element {self.model.name!r} stays in the plane of rotation, out of which a load "
                "moves the blade: take element='space_exact'"
            )
        for load in self.loads:
            if load.acts_on == "span":
                if not self.model.takes_wrenches:
                    raise ValueError(
                        f"element {self.model.name!r} takes loads on all mass, on the length and "
                        f"across the tip, and {load} acts on the span: take element='space_exact'"
                    )
                loaded((load,), self.blade)  # refuses a place beyond the tip
        if self.frame == "rotating" and not self.model.constant_mass:
            raise ValueError(
                f"element {self.model.name!r} is solved in the inertial frame, its inertia being "
                "no constant matrix: take frame='inertial'"
            )
        _ = self.steps_and_sampling
        self.describe()  # refuses what no file can hold

    @classmethod
    def described(cls, attrs: Mapping[Any, Any]) -> RunCase:
        """Return the case that the attributes of a run describe: `describe` inverted."""
        return cls(
            blade=beam_of(attrs),
            spin_up=motion_of(attrs),  # type: ignore[arg-type]  # others are refused
            element=from_description(json.loads(attrs["element_options"]), Formulation),
            elements=int(attrs["elements"]),
            duration=float(attrs["duration"]),
            step=float(attrs["step"]),
            frame=attrs["frame"],
            loads=loads_of(attrs),
        )

    @property
    def model(self) -> Formulation:
        """The formulation."""
        return cast(Formulation, self.element)

    @property
    def omega(self) -> float:
        """Steady angular velocity, after the ramp [rad/s]."""
        return self.spin_up.omega

    @property
    def ramp_time(self) -> float:
        """Time from rest to the steady angular velocity [s]; zero for a beam that turns already."""
        return float(getattr(self.spin_up, "ramp_time", 0.0))

    @property
    def rotation(self) -> Rotation:
        """Rotation of the clamp, ripples of its speed included."""
        return rippled(self.spin_up, self.loads)

    @property
    def exchanges_energy(self) -> bool:
        """Whether loads or damping bring energy or take it."""
        return bool(self.loads) or bool(self.blade.damping)

    @cached_property
    def steps_and_sampling(self) -> tuple[int, int]:
        """Number of steps, and of how many one is kept."""
        return checked_steps(
            self.blade, self.spin_up.fastest, self.ramp_time, self.duration, self.step,
            [self.omega if one.frequency is None else one.frequency for one in self.loads],
        )  # fmt: skip

    def describe(self) -> dict[str, Any]:
        """Return every input as plain values: the attributes of a run, and the key of a result."""
        return {
            **blade_attributes(self.blade),
            "omega": self.omega,
            "ramp_time": self.ramp_time,
            **motion_attributes(self.spin_up),
            "element": self.model.name,
            "element_options": json.dumps(describe(self.model)),
            "elements": self.elements,
            "duration": self.duration,
            "step": self.step,
            "frame": self.frame,
            **loads_attributes(self.loads),
        }
