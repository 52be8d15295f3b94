"""Blades in an Exudyn system of one's own: on one hub, driven or free, and the clamp's torque."""

from dataclasses import dataclass
from itertools import pairwise

import exudyn
import exudyn.itemInterface as eii
import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.optimize import brentq

from analytic import Damping, Gravity, Rectangle, SpeedRipple, SpinUp, SteadyRotation, TipForce
from rotbeam_exu import simulate
from rotbeam_exu.fem import add_rotating_beam
from rotbeam_exu.fem.solver import exudyn_system


@dataclass(frozen=True, kw_only=True)
class Late(SteadyRotation):
    """At 1 rad from the start."""

    def _at(self, t, derivative):
        return super()._at(t, derivative) + (1.0 if derivative == 0 else 0.0)


SPIN_UP = SpinUp(omega=3.0, ramp_time=1.5)


def add_hub(mbs, inertia, spin=0.0):
    """A rigid hub that turns about the origin; its node and a marker on it."""
    node = mbs.AddNode(eii.NodeRigidBody2D(initialVelocities=[0.0, 0.0, spin]))
    hub = mbs.AddObject(eii.ObjectRigidBody2D(mass=1.0, inertia=inertia, nodeNumber=node))
    ground = mbs.AddObject(eii.ObjectGround())
    axis, marker = (mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=n)) for n in (ground, hub))
    mbs.AddObject(eii.ObjectJointRevolute2D(markerNumbers=[axis, marker]))
    return node, marker


def drive_hub(mbs, node, rotation):
    """Let the hub's angle follow a rotation."""
    ground = mbs.AddNode(eii.NodePointGround())
    ends = [
        mbs.AddMarker(eii.MarkerNodeCoordinate(nodeNumber=n, coordinate=c))
        for n, c in ((ground, 0), (node, 2))
    ]
    mbs.AddObject(
        eii.ObjectConnectorCoordinate(
            markerNumbers=ends, offset=1.0,
            offsetUserFunction=lambda mbs, t, item, offset: rotation.angle(t),
            offsetUserFunction_t=lambda mbs, t, item, offset: rotation.rate(t),
        )
    )  # fmt: skip


def solve(mbs, numbers, duration=2.0, step=2e-3, every=10):
    mbs.Assemble()
    mbs.SolveDynamic(numbers.solver_settings(duration=duration, step=step, every=every))


def stored(mbs, sensor):
    return mbs.GetSensorStoredData(sensor)[:, 1:]


def momentum(mbs, numbers):
    """Angular momentum of a blade about the origin."""
    kind = exudyn.OutputVariableType
    e, v = (
        np.array([mbs.GetNodeOutput(n, variable) for n in numbers.nodes])
        for variable in (kind.Coordinates, kind.Coordinates_t)
    )
    e += numbers.chain.reference(mbs)
    return numbers.model.energy_and_momentum(
        numbers.blade, numbers.mass, numbers.chain.turning, e[None], v[None], np.zeros(1)
    )[1][0]


def test_driven_blades_do_not_feel_each_other(beam):
    blade = beam.with_hub_radius(0.5)
    with exudyn_system() as mbs:
        alone = add_rotating_beam(mbs, blade, SPIN_UP, elements=6)
        sensor = alone.add_torque_sensor(mbs)
        solve(mbs, alone)
        tip, torque = stored(mbs, alone.tip_sensor), stored(mbs, sensor)
    with exudyn_system() as mbs:
        azimuths = 2.0 * np.pi / 3.0 * np.arange(3)
        blades = [add_rotating_beam(mbs, blade, SPIN_UP, azimuth=a, elements=6) for a in azimuths]
        sensors = [one.add_torque_sensor(mbs) for one in blades]
        solve(mbs, blades[0])
        for azimuth, one, sensor in zip(azimuths, blades, sensors, strict=True):
            x, y, _ = stored(mbs, one.tip_sensor).T
            back = (x + 1j * y) * np.exp(-1j * azimuth)
            # Newton stops at a force of 1e-9 EI/L², and a step earlier or later than alone.
            assert back == pytest.approx(tip[:, 0] + 1j * tip[:, 1], abs=1e-9 * beam.length)
            assert stored(mbs, sensor) == pytest.approx(torque, abs=1e-8 * abs(torque).max())


def test_a_rotation_may_begin_at_an_angle(beam):
    late, steady = Late(omega=2.0), SteadyRotation(omega=2.0)
    ends = []
    for rotation, azimuth in ((steady, 0.0), (steady, 1.0), (late, 0.0)):
        with exudyn_system() as mbs:
            one = add_rotating_beam(mbs, beam, rotation, azimuth=azimuth, elements=2)
            solve(mbs, one, duration=0.5)
            x, y, _ = stored(mbs, one.tip_sensor).T
            ends.append(x + 1j * y)
    assert ends[0][0] == pytest.approx(beam.length)
    for other in ends[1:]:
        assert other == pytest.approx(ends[0] * np.exp(1j), abs=1e-8)
    run = simulate(beam, late, elements=2, duration=0.5, step=2e-3)
    assert run.tip_x[0].item() == pytest.approx(beam.length * np.cos(1.0))
    assert run.tip_x[-1].item() == pytest.approx(ends[1][-1].real, abs=1e-8)


@pytest.mark.parametrize("element", ["cable", "exact", "linear", "space_exact"])
def test_a_driven_hub_is_a_prescribed_rotation(beam, element):
    """With all the blade has; gravity as a load here, and as one of Exudyn's there."""
    blade, loads = beam, []
    if element == "cable":
        blade, loads = blade.with_hub_radius(0.5).with_tip_mass(0.0, 0.2), [Gravity(gravity=2.0)]
    if element == "exact":
        blade = blade.with_hub_radius(0.5)
    if element == "space_exact":
        blade = beam.with_shape(Rectangle()).with_hub_radius(0.5)
        blade = blade.with_precone(0.1).with_setting_angle(0.3)
    found = []
    for own in (False, True):
        with exudyn_system() as mbs:
            clamp = SPIN_UP
            if own:
                node, clamp = add_hub(mbs, 5.0)
                drive_hub(mbs, node, SPIN_UP)
            one = add_rotating_beam(
                mbs, blade, clamp, azimuth=0.7, element=element, elements=4,
                loads=() if own else loads,
            )  # fmt: skip
            for body in one.bodies if own and loads else ():
                onto = mbs.AddMarker(eii.MarkerBodyMass(bodyNumber=body))
                mbs.AddLoad(eii.LoadMassProportional(markerNumber=onto, loadVector=[0, -2.0, 0]))
            sensors = one.tip_sensor, one.add_torque_sensor(mbs)
            solve(mbs, one, duration=0.4, step=4e-3, every=5)
            found.append([stored(mbs, sensor) for sensor in sensors])
    (tip, torque), (own_tip, own_torque) = found
    # Newton stops at 1e-9 EI/L² in either, and constraint forces amplify that.
    assert own_tip == pytest.approx(tip, abs=1e-9 * beam.length)
    assert own_torque == pytest.approx(torque, abs=1e-8 * abs(torque).max())


@pytest.mark.parametrize("element", ["cable", "exact", "space_exact"])
def test_a_blade_starts_as_a_part_of_its_body(beam, element):
    """Wherever the body is, however it moves, and wherever the marker is on it."""
    blade, azimuth, kind = beam.with_hub_radius(0.5), 0.7, exudyn.OutputVariableType
    if element == "space_exact":
        blade = beam.with_shape(Rectangle()).with_hub_radius(0.5)
    seat = np.eye(4)
    seat[:2, [0, 1, 3]] = [[0.8, -0.6, 0.2], [0.6, 0.8, -0.1]]
    along = (0.5 + beam.length) * np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    with exudyn_system() as mbs:
        node = mbs.AddNode(
            eii.NodeRigidBody2D(
                referenceCoordinates=[1.0, 2.0, 0.3], initialCoordinates=[0.1, 0.2, 0.4],
                initialVelocities=[3.0, -1.0, 2.0],
            )
        )  # fmt: skip
        body = mbs.AddObject(eii.ObjectRigidBody2D(mass=1.0, inertia=1.0, nodeNumber=node))
        marker = mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=body, localHT=seat))
        end = seat[:3, :3] @ along + seat[:3, 3]
        there = mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=body, localPosition=end))
        one = add_rotating_beam(mbs, blade, marker, azimuth=azimuth, element=element, elements=2)
        mbs.Assemble()
        for variable in (kind.Position, kind.Velocity):
            found, expected = (mbs.GetMarkerOutput(m, variable) for m in (one.tip_marker, there))
            assert found == pytest.approx(expected, abs=1e-12 * beam.length)
            assert np.linalg.norm(expected) > 1.0


@pytest.mark.parametrize("element", ["ancf3", "space_cable", "space_exact"])
def test_the_torque_is_what_changes_the_momentum(beam, element):
    """Of elements that no joint clamps, too; from an azimuth, on a hub, with a precone."""
    blade = beam.with_hub_radius(0.5)
    if element == "space_cable":
        blade = blade.with_section_out_of_plane(bending_ratio=1.0)
    if element == "space_exact":
        blade = beam.with_shape(Rectangle()).with_hub_radius(0.5).with_precone(0.1)
    with exudyn_system() as mbs:
        one = add_rotating_beam(mbs, blade, SPIN_UP, azimuth=0.7, element=element, elements=4)
        sensor = one.add_torque_sensor(mbs)
        solve(mbs, one, duration=0.4, step=4e-3, every=1)
        given = trapezoid(stored(mbs, sensor)[:, 0], dx=4e-3)
        # The steps, of order two, leave 4e-5.
        assert given == pytest.approx(momentum(mbs, one), rel=1e-4)


@pytest.mark.parametrize("element", ["cable", "exact"])
def test_a_free_hub_and_its_blades_keep_angular_momentum(beam, element):
    """It has the impulse of a torque on the hub, and a blade that of its clamp."""
    impulse, inertia, end = 60.0, 5.0, 0.5
    blade = beam.with_hub_radius(0.5).with_tip_mass(0.0, 0.2)

    def drive(mbs, t, torque):
        return [0.0, 0.0, 2.0 * impulse / end * np.sin(np.pi * t / end) ** 2 if t < end else 0.0]

    with exudyn_system() as mbs:
        node, marker = add_hub(mbs, inertia, spin=2.0)
        mbs.AddLoad(eii.LoadTorqueVector(markerNumber=marker, loadVectorUserFunction=drive))
        blades = [
            add_rotating_beam(mbs, blade, marker, azimuth=a, element=element, elements=4)
            for a in (0.0, np.pi)
        ]
        mbs.Assemble()
        before = sum(momentum(mbs, one) for one in blades)
        # A straight blade that turns with the hub; the element's rotary inertia is the rest.
        ends = 0.5 + beam.length, 0.5
        straight = beam.mass_per_length * (ends[0] ** 3 - ends[1] ** 3) / 3.0 + 0.2
        assert before == pytest.approx(2.0 * 2.0 * straight, rel=1e-3)
        sensors = [one.add_torque_sensor(mbs) for one in blades]
        solve(mbs, blades[0], duration=0.8, step=2e-3, every=1)
        gain = sum(momentum(mbs, one) for one in blades) - before
        rate = mbs.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates_t)[2]
        given = sum(trapezoid(stored(mbs, sensor)[:, 0], dx=2e-3) for sensor in sensors)
    # The blades start unstretched, and the waves that this makes cost 2e-5 at this step.
    assert inertia * (rate - 2.0) + gain == pytest.approx(impulse, abs=5e-5 * impulse)
    assert given == pytest.approx(gain, rel=5e-5)


def in_phase(beam, blades, inertia, radius, count):
    """Frequencies of equal blades on a free hub, at rest: y = aφ, y' = φ at the root.

    EI y'''' = m ω² y, and J ω² φ = n (a EI y''' - EI y'') of the hub.
    """
    EI, m, L = beam.bending_stiffness, beam.mass_per_length, beam.length

    def shape(k, x):
        """Derivatives 0 to 3 of cos, sin, cosh and sinh."""
        c, s, C, S = np.cos(k * x), np.sin(k * x), np.cosh(k * x), np.sinh(k * x)
        rows = [(c, s, C, S), (-s, c, S, C), (-c, -s, C, S), (s, -c, S, C)]
        return np.array(rows) * k ** np.arange(4.0)[:, None]

    def determinant(k):
        root, tip = shape(k, 0.0), shape(k, L)
        hub = inertia * EI * k**4 / m * root[1] + blades * EI * (root[2] - radius * root[3])
        return np.linalg.det(np.stack((root[0] - radius * root[1], hub, tip[2], tip[3])))

    grid = np.linspace(0.3, 12.0, 400) / L
    values = [determinant(k) for k in grid]
    roots = [
        brentq(determinant, *ends)
        for ends, signs in zip(pairwise(grid), pairwise(values), strict=True)
        if signs[0] * signs[1] < 0.0
    ]
    return np.array(roots[:count]) ** 2 * np.sqrt(EI / m)


@pytest.mark.parametrize("blades", [2, 3])
def test_frequencies_on_a_free_hub(beam, blades):
    """Out of phase those of the clamped blade; in phase the hub turns against the blades."""
    inertia, radius = 0.1 * beam.mass * beam.length**2, 0.5
    with exudyn_system() as mbs:
        _, marker = add_hub(mbs, inertia)
        for k in range(blades):
            add_rotating_beam(
                mbs, beam.with_hub_radius(radius), marker, azimuth=2.0 * np.pi * k / blades
            )
        mbs.Assemble()
        squares = mbs.ComputeODE2Eigenvalues()[0]
    found = np.sqrt(np.abs(squares))
    clamped = np.array([3.516015, 22.034492]) * beam.frequency_scale
    coupled = in_phase(beam, blades, inertia, radius, 2)
    out_of_phase = np.repeat(clamped, blades - 1)
    expected = [0.0, *np.sort(np.concatenate((out_of_phase, coupled)))]
    # 16 cables have the second frequency to 5e-6; zero is the square root of round-off.
    assert found[1 : len(expected)] == pytest.approx(expected[1:], rel=1e-5)
    assert found[0] < 1e-3
    assert coupled[0] > 2.0 * clamped[0]


@pytest.mark.parametrize(
    ("marker", "options", "sentence"),
    [
        (None, {"element": "ancf3"}, "no joint clamps element 'ancf3'.*take 'cable', 'exact',"),
        (None, {"element": "space_cable"}, "no joint clamps element 'space_cable'"),
        (None, {"loads": [Gravity(gravity=2.0)]}, "the angle of the clamp is not known beforehand"),
        (None, {"frame": "rotating"}, "the angle of the clamp is not known beforehand"),
        (eii.MarkerNodeRigid(nodeNumber=0), {}, "got a MarkerNodeRigid: add one to your hub"),
        (
            eii.MarkerBodyRigid(bodyNumber=0, localHT=np.diag([1.0, -1.0, -1.0, 1.0])), {},
            r"z axis of its marker is \[ ?-?0. +0. -1.\]: turn the marker by its localHT",
        ),
    ],
)  # fmt: skip
def test_what_no_joint_clamps_is_refused(beam, marker, options, sentence):
    if options.get("element") == "space_cable":
        beam = beam.with_section_out_of_plane(bending_ratio=1.0)
    with exudyn_system() as mbs:
        _, clamp = add_hub(mbs, 1.0)
        if marker is not None:
            clamp = mbs.AddMarker(marker)
        with pytest.raises(ValueError, match=sentence):
            add_rotating_beam(mbs, beam, clamp, elements=2, **options)


def test_a_body_is_no_clamp(beam):
    with exudyn_system() as mbs:
        body = mbs.AddObject(eii.ObjectGround())
        with pytest.raises(TypeError, match="a marker that AddMarker gave, got "):
            add_rotating_beam(mbs, beam, body)


def test_the_settings_are_those_of_simulate(beam):
    """A blade with all there is, in any units: forces in mm and t are 1000 times those in SI."""
    blade = beam.with_hub_radius(0.5).with_tip_mass(0.1).with_damping(Damping(external=0.02))
    loads = [Gravity(2.0), SpeedRipple(amplitude=0.1, frequency=5.0)]
    loads += [TipForce(amplitude=0.3, frequency=2.0)]
    run = simulate(blade, SPIN_UP, elements=4, duration=2.0, step=4e-3, loads=loads)
    with exudyn_system() as mbs:
        one = add_rotating_beam(mbs, blade, SPIN_UP, elements=4, loads=loads)
        sensor = one.add_torque_sensor(mbs)
        solve(mbs, one, step=4e-3, every=50)
        assert stored(mbs, sensor)[-1] == pytest.approx(run.clamp_torque[-1].item(), rel=1e-7)
        tip = stored(mbs, one.tip_sensor)[-1]
        assert tip[:2] == pytest.approx([run.tip_x[-1].item(), run.tip_y[-1].item()], abs=1e-8)
        settings = one.solver_settings(duration=2.0, step=4e-3)
        with pytest.raises(ValueError, match="not a whole number of steps"):
            one.solver_settings(duration=2.0, step=3e-3)
    with exudyn_system() as mbs:
        other = add_rotating_beam(mbs, beam.in_units(1e-3, 1.0, 1.0), SPIN_UP, elements=4)
        scaled = other.solver_settings(duration=2.0, step=4e-3)
    ratio = (
        scaled.timeIntegration.newton.absoluteTolerance
        / settings.timeIntegration.newton.absoluteTolerance
    )
    assert ratio == pytest.approx(1e3, rel=1e-12)
