"""The model for an Exudyn system of one's own: a robot, a hub or a gear may be added to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from analytic import AnyBlade
from analytic.input_checks import whole_number
from analytic.lazily import sparse
from analytic.loads import Load, loads_in_time, rippled
from analytic.motion import Rotation

from . import drive
from .elements import Chain, Formulation, formulation, require_modeled
from .frame import Frame
from .lazily import exudyn, items
from .loading import Loading
from .solver import mass_matrix


@dataclass(frozen=True, kw_only=True)
class RotatingBeam:
    """The numbers of what `add_rotating_beam` added.

    Attributes
    ----------
    model : Formulation
    chain : Chain
        Its nodes, from the clamped root to the tip, and its bodies.
    root_marker, tip_marker : MarkerIndex
        Positions, to which forces and other bodies can be attached.
    tip_sensor : SensorIndex
        Position of the tip, stored in the sensor itself.
    clamp : tuple
        Constraints of the root, whose forces are what the blade exerts on the clamp.
    mass : csr_array
        Mass matrix over the coordinates of the nodes, root first, but for the inertia of the
        chain's turning nodes.
    rotation : Rotation
        Of the clamp, ripples of its speed included.
    loading : Loading
        Loads and external damping.
    """

    model: Formulation
    chain: Chain
    root_marker: exudyn.MarkerIndex
    tip_marker: exudyn.MarkerIndex
    tip_sensor: exudyn.SensorIndex
    clamp: tuple[exudyn.ObjectIndex, ...]
    mass: sparse.csr_array
    rotation: Rotation
    loading: Loading

    @property
    def nodes(self) -> tuple[exudyn.NodeIndex, ...]:
        """Nodes from the root to the tip."""
        return self.chain.nodes

    @property
    def bodies(self) -> tuple[exudyn.ObjectIndex, ...]:
        """The elements, where they are Exudyn's."""
        return self.chain.bodies


def add_rotating_beam(
    mbs: exudyn.MainSystem,
    beam: AnyBlade,
    rotation: Rotation,
    *,
    element: str | Formulation = "cable",
    elements: int = 16,
    frame: Frame = "inertial",
    loads: Sequence[Load] = (),
) -> RotatingBeam:
    """Put a beam whose clamped end follows `rotation` into an Exudyn system.

    The system is not assembled yet. The beam lies along its x axis, clamped at the origin or on its
    hub, straight and at rest. It bends in the direction y, out of the plane of rotation by the
    setting angle. `simulate` builds its model by this.

    Parameters
    ----------
    mbs : exudyn.MainSystem
    beam : Beam or Blade
        In the units of the system, SI as a rule.
    rotation : SpinUp, FourierRamp, SpeedTable or SteadyRotation
        Angle of the clamp over time.
    element, elements, frame, loads
        As in `simulate`; loads in the units of the system.

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
    (9, 8, 3)
    """
    model, elements = formulation(element), whole_number("elements", elements)
    require_modeled(beam, model, frame)
    loads = loads_in_time(loads)
    rotation = rippled(rotation, loads)
    chain = model.lay(mbs, beam, elements)
    mass = mass_matrix(model, beam, elements)
    if frame == "inertial":
        clamp = drive.prescribe_rotation(mbs, chain, model, rotation, beam.hub_radius)
    else:
        clamp = drive.hold_root(mbs, chain, model)
        drive.add_inertial_forces(mbs, chain, model, mass, rotation, model.setting(beam))
        model.add_spin_forces(mbs, chain, beam, rotation)
    loading = Loading(model, beam, elements, mass, loads)
    if loading:
        loading.add(mbs, chain, rotation, frame)
    root, tip = (
        mbs.AddMarker(items.MarkerNodePosition(nodeNumber=chain.nodes[end])) for end in (0, -1)
    )
    sensor = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=chain.nodes[-1],
            outputVariableType=exudyn.OutputVariableType.Position,
            storeInternal=True,
            writeToFile=False,
        )
    )
    return RotatingBeam(
        model=model, chain=chain, root_marker=root, tip_marker=tip, tip_sensor=sensor,
        clamp=tuple(clamp), mass=mass, rotation=rotation, loading=loading,
    )  # fmt: skip
