"""The model for an Exudyn system of one's own: a robot, a hub or a gear may be added to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from analytic import Blade
from analytic.input_checks import finite_number, whole_number
from analytic.lazily import sparse
from analytic.loads import Load, loads_in_time, rippled
from analytic.motion import Rotation

from ..runs import Frame
from ..runs.check import whole_steps
from . import drive
from .elements import Chain, Formulation, formulation, require_joint, require_modeled
from .lazily import exudyn, items
from .loading import Loading
from .solver import mass_matrix, round_off
from .units import Units, restated

_TOLERANCE = 1e-9
"""Newton's absolute tolerance of forces, in EI/L², where round-off allows it."""


@dataclass(frozen=True, kw_only=True)
class RotatingBeam:
    """The numbers of what `add_rotating_beam` added.

    Attributes
    ----------
    model : Formulation
    chain : Chain
        Its nodes, from the clamped root to the tip, and its bodies.
    tip_marker : MarkerIndex
        Position of the tip, to which forces and other bodies can be attached; of "space_exact" that
        of the center of mass of its section.
    tip_sensor : SensorIndex
        Position of the tip, stored in the sensor itself.
    torque : callable
        Torque [N m] that the clamp exerts on the blade about the axis of rotation, or with a
        setting angle about the normal of the plane of bending: ``torque(mbs, t)`` in your own user
        functions. `add_torque_sensor` stores it.
    clamp : tuple
        Constraints of the root, or its joint with the body.
    mass : csr_array
        Mass matrix over the coordinates of the nodes, root first, but for the inertia of the
        chain's turning nodes.
    beam, elements, frame
        As given.
    loading : Loading
        Loads and external damping.
    """

    model: Formulation
    blade: Blade
    elements: int
    frame: Frame
    chain: Chain
    tip_marker: exudyn.MarkerIndex
    tip_sensor: exudyn.SensorIndex
    torque: drive.Torque
    clamp: tuple[exudyn.ObjectIndex, ...]
    mass: sparse.csr_array
    loading: Loading

    @property
    def nodes(self) -> tuple[exudyn.NodeIndex, ...]:
        """Nodes from the root to the tip."""
        return self.chain.nodes

    @property
    def bodies(self) -> tuple[exudyn.ObjectIndex, ...]:
        """The elements, where they are Exudyn's."""
        return self.chain.bodies

    def add_torque_sensor(self, mbs: exudyn.MainSystem) -> exudyn.SensorIndex:
        """Add a sensor of the clamp's torque, stored in the sensor itself."""
        return mbs.AddSensor(
            items.SensorUserFunction(
                sensorUserFunction=lambda mbs, t, *others: [self.torque(mbs, t)],
                storeInternal=True,
                writeToFile=False,
            )
        )

    def solver_settings(
        self, *, duration: float, step: float, every: int = 1
    ) -> exudyn.SimulationSettings:
        """Return settings for `mbs.SolveDynamic`, those of `simulate`: fixed steps, no files.

        Newton stops at a force that is small for the blade. Exudyn's own settings ask for a
        relative residual that round-off does not reach, and halve steps in vain.

        Parameters
        ----------
        duration, step : float
            In the system's unit of time; the one holds a whole number of the other.
        every : int
            Of how many steps sensors keep one.
        """
        units = Units.of(self.blade, step)
        # A tolerance below the round-off is never met, and one relative to the first residual
        # would loosen with the axial stiffness.
        tolerance = max(_TOLERANCE, round_off(units.blade(self.blade), self.elements))
        inertial, model = self.frame == "inertial", self.model
        settings = exudyn.SimulationSettings()
        integration = settings.timeIntegration
        integration.numberOfSteps = whole_steps(duration, step)
        integration.endTime = integration.numberOfSteps * step
        integration.adaptiveStep = False
        integration.generalizedAlpha.spectralRadius = model.spectral_radius if inertial else 1.0
        integration.newton.relativeTolerance = 1e-14
        integration.newton.absoluteTolerance = units.energy / units.length * tolerance
        # In the rotating frame each iteration calls back into Python, and this saves iterations.
        integration.newton.modifiedNewtonJacUpdatePerStep = model.new_jacobians or not inertial
        integration.verboseMode = 0
        settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
        settings.solution.file.write = False
        # Exactly the interval: a little under it, samples would drift off the grid.
        settings.solution.sensors.writePeriod = every * step
        return settings


def add_rotating_beam(
    mbs: exudyn.MainSystem,
    blade: Blade,
    clamp: Rotation | exudyn.MarkerIndex,
    *,
    azimuth: float = 0.0,
    element: str | Formulation = "cable",
    elements: int = 16,
    frame: Frame = "inertial",
    loads: Sequence[Load] = (),
) -> RotatingBeam:
    """Put a beam with a rotating clamp into an Exudyn system.

    The system is to be assembled afterwards. The beam lies along its x axis, turned by `azimuth`,
    clamped at the origin or on its hub, straight and at rest in the clamp. It bends in the
    direction y, out of the plane of rotation by the setting angle. `simulate` builds its model by
    this.

    Parameters
    ----------
    mbs : exudyn.MainSystem
    blade : Blade
        In the units of the system, SI as a rule.
    clamp : SpinUp, FourierRamp, SpeedTable, SteadyRotation or MarkerIndex
        Angle over time; or a MarkerBodyRigid on a body of yours, such as a hub that turns freely or
        by a drive. Its origin is the axis, its z axis at first the global one. The hub's radius is
        that of the blade, and the blade starts moving with the body.
    azimuth : float
        Angle of the clamp's line [rad] before it turns; from the x axis of a marker.
    element, elements, frame, loads
        As in `simulate`; loads in the units of the system. At a marker the frame is inertial, and
        loads and external damping are Exudyn's own, on `bodies` or `nodes`.

    Raises
    ------
    ValueError, TypeError
        If an input is refused, or the formulation does not model the blade.

    Examples
    --------
    >>> import exudyn
    >>> from analytic import Beam, SpinUp
    >>> from rotbeam_exu.fem import add_rotating_beam
    >>> mbs = exudyn.SystemContainer().AddSystem()
    >>> blade = Beam.reference().with_hub_radius(0.5)
    >>> numbers = add_rotating_beam(mbs, blade, SpinUp(omega=3.0, ramp_time=3.0), elements=8)
    >>> mbs.Assemble()
    >>> len(numbers.nodes), len(numbers.bodies), numbers.tip_marker
    (9, 8, 2)
    >>> mbs.SolveDynamic(numbers.solver_settings(duration=0.5, step=5e-3))
    True
    """
    model, elements = formulation(element), whole_number("elements", elements)
    require_modeled(blade, model, frame)
    loads, azimuth = loads_in_time(loads), finite_number("azimuth", azimuth)
    on_body = isinstance(clamp, exudyn.MarkerIndex)
    if on_body:
        require_joint(model)
        if loads or blade.damping.external or frame != "inertial":
            raise ValueError(
                "at a marker the angle of the clamp is not known beforehand: take "
                "frame='inertial', a blade without external damping, and for loads Exudyn's own "
                "on bodies or nodes"
            )
    elif not hasattr(clamp, "angle"):
        raise TypeError(f"clamp must be a rotation, or a marker that AddMarker gave, got {clamp!r}")
    chain = model.lay(mbs, blade, elements)
    mass = mass_matrix(model, blade, elements)
    loading = Loading(model, blade, elements, mass, loads)
    if on_body:
        constraints, torque = drive.clamp_to_body(mbs, chain, model, clamp, azimuth)
    else:
        rotation = rippled(clamp, loads)
        if azimuth:
            rotation = restated(rotation, azimuth=azimuth)
        if frame == "inertial":
            constraints = drive.prescribe_rotation(mbs, chain, model, rotation)
        else:
            constraints = [drive.hold_root(mbs, chain, model)]
            drive.add_inertial_forces(mbs, chain, model, mass, rotation, model.setting(blade))
            model.add_spin_forces(mbs, chain, blade, rotation)
        angle = rotation.angle if frame == "inertial" else lambda t: 0.0
        torque = drive.torque_of(mbs, chain, model, constraints, angle)
        if loading:
            loading.add(mbs, chain, rotation, frame)
    tip = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=chain.nodes[-1]))
    sensor = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=chain.nodes[-1],
            outputVariableType=exudyn.OutputVariableType.Position,
            storeInternal=True,
            writeToFile=False,
        )
    )
    return RotatingBeam(
        model=model, blade=blade, elements=elements, frame=frame, chain=chain, tip_marker=tip,
        tip_sensor=sensor, torque=torque, clamp=tuple(constraints), mass=mass, loading=loading,
    )  # fmt: skip
