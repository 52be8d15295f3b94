"""A load, a motion and an element of one's own: a class each, here, and known everywhere."""

from dataclasses import dataclass, fields, replace
from typing import ClassVar

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    DistributedForce,
    FourierRamp,
    Rectangle,
    SpeedRipple,
    SpeedTable,
    SpinUp,
    SteadyRotation,
    Theory,
    TipForce,
    forced_response,
    spin_up_response,
)
from analytic.description import describe, from_description
from analytic.loads import HarmonicLoad, Load
from analytic.motion import Motion, Rippled, SpeedChange
from rotbeam_exu import dataset_of, figures, load, natural_frequencies, save, simulate
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.fem.elements import Cable
from rotbeam_exu.files.results import differing_inputs
from rotbeam_exu.runs.attributes import (
    beam_of,
    blade_attributes,
    loads_of,
    motion_attributes,
    motion_of,
)
from rotbeam_exu.verification.cases import spin_up_case
from rotbeam_exu.verification.entries import formulation_entry
from rotbeam_exu.verification.verify import submission_of


@dataclass(frozen=True, kw_only=True)
class TipPull(HarmonicLoad):
    """A force on the tip along the undeformed blade, P cos νt."""

    unit: ClassVar[str] = "N"
    symbol: ClassVar[str] = "P"
    called: ClassVar[str] = "a tip pull"
    dimension: ClassVar[tuple[int, int, int]] = (1, 1, -2)
    acts_on: ClassVar[str] = "tip"

    def force(self, phase, angle, setting):
        return self.amplitude * np.cos(phase) + 0j


@dataclass(frozen=True, kw_only=True)
class Shake(HarmonicLoad):
    """A clamp that is shaken across the blade, seen from the clamp: a force on all mass."""

    unit: ClassVar[str] = "m/s²"
    symbol: ClassVar[str] = "a"
    called: ClassVar[str] = "a shake"
    dimension: ClassVar[tuple[int, int, int]] = (1, 0, -2)
    acts_on: ClassVar[str] = "mass"


@dataclass(frozen=True, kw_only=True)
class ObliqueForce(TipForce):
    """A force on the tip with a part along the undeformed blade."""

    along: float = 0.0

    dimensions: ClassVar[dict[str, tuple[int, int, int]]] = {"along": (1, 1, -2)}

    def force(self, phase, angle, setting):
        return (self.along + 1j * self.amplitude) * np.cos(phase)


@dataclass(frozen=True, kw_only=True)
class HalfTold(ObliqueForce):
    """One that does not tell what its other number is."""

    dimensions: ClassVar[dict[str, tuple[int, int, int]]] = {}


@dataclass(frozen=True, kw_only=True)
class Heave(Shake):
    """A clamp that is shaken along the axis of rotation."""

    def force(self, phase, angle, setting):
        return 0j * phase

    def lift(self, phase):
        return self.amplitude * np.cos(phase)


@dataclass(frozen=True, kw_only=True)
class Moment(Shake):
    """A moment on each section, which blades do not take."""

    acts_on: ClassVar[str] = "sections"


@dataclass(frozen=True, kw_only=True)
class Gust(DistributedForce):
    """A wind that comes and goes in one direction, whatever the angle."""

    def force(self, phase, angle, setting):
        return self.amplitude * np.cos(phase) * np.exp(-1j * angle)


@dataclass(frozen=True)
class Wind(Load):
    """A wind that blows in one direction, whatever the angle, and has no frequency."""

    pressure: float

    unit: ClassVar[str] = "N/m"
    symbol: ClassVar[str] = "p"
    called: ClassVar[str] = "a wind"
    dimension: ClassVar[tuple[int, int, int]] = (0, 1, -2)
    acts_on: ClassVar[str] = "length"

    def force(self, phase, angle, setting):
        return self.pressure * np.exp(-1j * angle)


@dataclass(frozen=True, kw_only=True)
class HalfSine(SpeedChange):
    """A change of the speed whose acceleration is half a sine."""

    omega: float
    ramp_time: float
    start: float = 0.0

    @property
    def shortest_wave(self):
        return 2.0 * self.ramp_time

    def _within(self, t, derivative):
        half, phase = 0.5 * (self.omega - self.start), np.pi * np.asarray(t) / self.ramp_time
        if derivative == 2:
            return np.pi / self.ramp_time * half * np.sin(phase)
        if derivative == 1:
            return self.start + half * (1.0 - np.cos(phase))
        return self.start * t + half * (t - self.ramp_time / np.pi * np.sin(phase))


@dataclass(frozen=True, kw_only=True)
class SoftCable(Cable):
    """A cable of a softer material, that says nothing of its name, and so has its own."""

    share: float = 0.5

    def lay(self, mbs, beam, elements):
        soft = replace(beam, youngs_modulus=self.share * beam.youngs_modulus)
        return super().lay(mbs, soft, elements)


MOTION = HalfSine(omega=4.0, ramp_time=2.0)
PULL = TipPull(amplitude=20.0, frequency=0.0)


def test_exudyn_and_theory_agree_on_them(beam):
    time, wind, force = np.linspace(0.0, 3.0, 61), Wind(0.5), TipForce(amplitude=1.0, frequency=3.0)
    loads = [PULL, wind, force]
    run = simulate(beam, MOTION, elements=6, duration=3.0, step=4e-3, frame="rotating", loads=loads)
    exact, *less = (
        spin_up_response(beam, MOTION, time, tolerance=1e-4, loads=acting).q
        for acting in (loads, [wind, force], [PULL, force])
    )
    largest = np.abs(exact).max()
    # Six cables at 4 ms.
    assert np.interp(time, run["time"], run["q"]) == pytest.approx(exact, abs=2e-3 * largest)
    assert min(np.abs(exact - other).max() for other in less) > 0.1 * largest
    with pytest.raises(TypeError, match="the frequency of a load, and a wind of 0.5 N/m has none"):
        forced_response(beam, 6.0, wind, [3.6, 3.7])


def test_all_numbers_of_a_load_have_their_units(beam):
    time, both = np.linspace(0.0, 3.0, 16), {"amplitude": 0.5, "frequency": 3.0}
    oblique = [ObliqueForce(along=0.5, **both)]
    run = simulate(beam, MOTION, elements=6, duration=3.0, step=4e-3, loads=oblique)
    exact, parts = (
        spin_up_response(beam, MOTION, time, tolerance=1e-4, loads=loads).q
        for loads in (oblique, [TipPull(amplitude=0.5, frequency=3.0), TipForce(**both)])
    )
    assert exact == pytest.approx(parts, abs=1e-9)
    # Six cables at 4 ms.
    assert np.interp(time, run["time"], run["q"]) == pytest.approx(exact, abs=0.02)


@pytest.mark.parametrize(
    ("load", "error", "sentence"),
    [
        (
            HalfTold(amplitude=1.0, along=1.0),
            TypeError,
            "a half told of 1 N has along of un",
        ),
        (Moment(amplitude=1.0), TypeError, "acts on 'sections': let it be one of mass, length"),
        (Heave(amplitude=1.0), ValueError, r"leave the plane.*with_section_out_of_plane\(bend"),
        (Gust(amplitude=1.0), ValueError, "a gust of 1 N/m goes by the angle of the clamp as well"),
    ],
)
def test_loads_that_cannot_be_are_refused(beam, load, error, sentence):
    with pytest.raises(error, match=sentence):
        forced_response(beam, 6.0, load, [3.6, 3.7])


def test_a_new_load_has_a_response_a_file_and_a_picture(tmp_path):
    blade = Beam.reference().with_damping(Damping(external=0.1))
    # On a uniform blade a force per mass is one per length.
    push = DistributedForce(amplitude=0.5 * blade.mass_per_length)
    mine, theirs = (
        forced_response(blade, 6.0, one, [3.6, 3.7, 3.8], functions=8)
        for one in (Shake(amplitude=0.5), push)
    )
    assert mine.amplitude[mine.at(3.7)] == pytest.approx(theirs.amplitude[theirs.at(3.7)], rel=1e-9)
    data = load(save(dataset_of(mine), tmp_path / "shaken.nc"))
    assert loads_of(data.attrs) == (mine.load,)
    assert list(differing_inputs(dataset_of(theirs), tmp_path / "shaken.nc")) == [
        "load", "load_size", "load_symbol", "load_unit", "loads"
    ]  # fmt: skip
    names = [text.get_text() for text in figures.forced_response(data).get_legend().get_texts()]
    assert names[0] == "a = 0.5 m/s², $d$ = 0.1 kg/(m s)"
    assert mine.plot().get_legend().get_texts()[0].get_text() == "a shake of 0.5 m/s²"


def test_a_run_and_its_file_say_what_drove_it(beam, tmp_path):
    model = SoftCable(share=0.25)
    run = simulate(beam, MOTION, element=model, elements=2, duration=2.5, step=5e-3, loads=[PULL])
    attrs = load(save(run, tmp_path / "run.nc")).attrs
    again = RunCase.described(attrs)
    assert (again.spin_up, again.loads, again.model) == (MOTION, (PULL,), model)
    assert motion_of(attrs) == MOTION
    assert loads_of(attrs) == (PULL,)
    assert (attrs["element"], Cable.name) == ("SoftCable", "cable")
    soft, cable = (
        natural_frequencies(beam, 0.0, element=one, elements=4)[0] for one in (again.model, "cable")
    )
    assert soft == pytest.approx(0.5 * cable, rel=1e-6)


@pytest.mark.parametrize(
    "motion",
    [
        MOTION, FourierRamp(start=1.0, omega=2.0, ramp_time=2.0, cosines=(-1.2, 0.2)),
        SpeedTable([0.0, 1.0, 2.0], [0.5, 1.0, 2.0]), SpinUp(omega=2.0, ramp_time=2.0),
    ],
    ids=lambda motion: type(motion).__name__,
)  # fmt: skip
def test_an_exact_spin_up_says_what_drove_it(beam, motion, tmp_path):
    ripple = SpeedRipple(amplitude=0.2, frequency=5.0)
    time = np.linspace(0.0, 2.5, 6)
    response = spin_up_response(
        beam, motion, time, tolerance=1e-3, loads=[ripple], theory=Theory(rotary_inertia=True)
    )
    data = load(save(dataset_of(response), tmp_path / "exact.nc"))
    assert motion_of(data.attrs) == motion
    assert loads_of(data.attrs) == (ripple,)
    # One of Eq. 1, between the same speeds in the same time, is another one.
    other = SpinUp(omega=motion.omega, ramp_time=2.0)
    like = dataset_of(replace(response, spin_up=other))
    named = differing_inputs(like, tmp_path / "exact.nc").keys() & {"motion", "loads", "omega"}
    assert named == (set() if motion == other else {"motion"})
    assert data.attrs["rotary_inertia"] == 1
    assert data["angle"].to_numpy() == pytest.approx(
        motion.angle(time) + 0.04 * np.sin(5.0 * time), abs=1e-12
    )


def test_a_rotation_with_a_ripple_is_no_other():
    motion = Rippled(rotation=SpeedTable([0.0, 1.0], [0.0, 2.0]), amplitude=0.1, frequency=3.0)
    assert from_description(describe(motion), Motion) == motion
    assert motion_of({**motion_attributes(motion), "omega": 2.0, "ramp_time": 1.0}) == motion


class Quick(SpinUp):
    """A ramp that is no dataclass of its own, and so looks like Eq. 1."""

    def rate(self, t):
        return 2.0 * super().rate(t)


@dataclass(frozen=True)
class Listed(SpeedChange):
    """A ramp with a field that no file can hold."""

    speeds: object
    omega: float = 2.0
    ramp_time: float = 1.0
    start: float = 0.0
    shortest_wave: float = 1.0

    def _within(self, t, derivative):
        return np.interp(t, [0.0, 1.0], self.speeds)


class Foreign:
    """A motion that inherits from nothing here."""

    omega, ramp_time, start, shortest_wave = 2.0, 1.0, 0.0, 1.0


class Heavy(Beam):
    """A beam with a mass that its fields do not tell."""


def heavy():
    beam = Beam.reference()
    return Heavy(**{one.name: getattr(beam, one.name) for one in fields(beam) if one.init})


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"spin_up": Quick(omega=2.0, ramp_time=1.0)}, "Quick be a frozen dataclass that inherits"),
        ({"spin_up": Listed(np.array([0.0, 2.0]))}, "the fields of .*Listed be numbers, text"),
        ({"spin_up": Foreign()}, "must be a SpinUp, a FourierRamp, a SpeedTable, another Speed"),
        (
            {"spin_up": Rippled(rotation=SteadyRotation(omega=1.0), amplitude=1.0, frequency=1.0)},
            "a ripple of it is one of the loads",
        ),
        ({"blade": heavy()}, "Heavy be a frozen dataclass that inherits"),
    ],
)
def test_what_is_not_known_is_refused_before_it_is_computed(beam, change, sentence):
    given = {"blade": beam, "spin_up": MOTION, **change}
    with pytest.raises(TypeError, match=sentence):
        simulate(**given, elements=2, duration=2.5, step=1e-2)


def test_what_a_file_tells_of_and_nobody_defined_is_refused():
    told = describe(MOTION)
    with pytest.raises(ValueError, match="'Unheard' is no known Motion: import the module that"):
        from_description({**told, "kind": "Unheard"}, Motion)
    with pytest.raises(ValueError, match="'HalfSine' is no known Load"):
        from_description(told, Load)
    with pytest.raises(ValueError, match="this is no HalfSine as .*test_new_kinds.HalfSine def"):
        from_description({**told, "jerk": 1.0}, Motion)


def test_two_kinds_cannot_have_one_name():
    with pytest.raises(
        TypeError, match="know analytic.ramps.SpeedTable by the name SpeedTable: give"
    ):

        class SpeedTable(SpeedChange):
            """Another table."""

    one, two = (type("Again", (SpeedChange,), {"__module__": "cell"}) for _ in range(2))
    assert one is not two, "a notebook's cell may run again"


def test_blades_are_read_back(beam):
    strip = beam.with_shape(Rectangle()).with_tip_mass(0.1, 0.2).with_damping(Damping(axial=1e-3))
    stiff = beam.with_section_out_of_plane(1.0, np.inf)
    for blade in (beam, strip, beam.with_setting_angle(1.0), stiff):
        assert beam_of(blade_attributes(blade)) == blade
        assert from_description(describe(blade), type(blade)) == blade


def test_a_new_case_of_the_benchmark_is_handed_in_whole(beam):
    blade = beam.with_point_mass(0.1, 4.0).with_setting_angle(0.3)
    case = replace(
        spin_up_case(blade.with_damping(Damping(external=0.05)), MOTION, 3.0),
        loads=(TipForce(amplitude=0.5, frequency=3.0),),
    )
    run = submission_of(formulation_entry(Cable(), elements=4, step=4e-3), [case]).runs[-1]
    exact = spin_up_response(case.blade, MOTION, run.time, tolerance=1e-3, loads=case.loads).q
    assert run.elements == 8
    # Eight cables at 8 ms; without the mass, the angle, drag or the force 0.05 or more.
    assert run.q == pytest.approx(exact, abs=5e-3 * np.abs(exact).max())
