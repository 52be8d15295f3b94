"""Every refusal is a sentence of ours: no AttributeError, MemoryError or ZeroDivisionError."""

import inspect

import numpy as np
import pytest

import analytic
import rotbeam_exu
from analytic import (
    Beam,
    Blade,
    Damping,
    PointMass,
    Rectangle,
    RotbeamWarning,
    Section,
    SpinUp,
    Theory,
    TipForce,
    Variant,
    backbone_curve,
    campbell,
    damping_ratios,
    design_ramp,
    linear_modes,
    linear_response,
    residual_amplitude,
    stability_limit,
)  # fmt: skip
from rotbeam_exu import natural_frequencies, simulate

BEAM = Beam.reference()
STRIP = BEAM.with_shape(Rectangle())
DAMPED = BEAM.with_damping(Damping(external=0.1))
PUSH = TipForce(amplitude=0.5)
SLOW = SpinUp(omega=2.0, ramp_time=1.0)
SECTION = BEAM.section

# What a public function needs beside the beam; each is refused for its beam before.
OTHERS = {
    "omega": 6.0, "spin_up": SLOW, "motion": SLOW, "times": [1.0], "amplitudes": [0.1],
    "load": PUSH, "frequencies": [3.6, 3.7], "duration": 2.0, "omegas": [2.0, 4.0],
    "amplitude": 0.1, "ramp_times": [3.0], "ratios": [2.0, 3.0], "substructures": 2,
    "inputs": [PUSH],
}  # fmt: skip


def needed(function):
    """Arguments of a function, but the beam, that it cannot do without."""
    return {name: OTHERS[name] for name in inspect.signature(function).parameters if name in OTHERS}


OF_A_BEAM = [
    (package, name)
    for package in (analytic, rotbeam_exu)
    for name in package.__all__
    if inspect.isfunction(getattr(package, name))
    and next(iter(inspect.signature(getattr(package, name)).parameters), "") == "blade"
]


@pytest.mark.parametrize(("package", "name"), OF_A_BEAM, ids=str)
@pytest.mark.parametrize(
    "wrong", [3.0, "Beam", Beam, BEAM.unit], ids=["3", "text", "class", "unit"]
)
def test_what_is_no_beam_is_refused(package, name, wrong):
    function = getattr(package, name)
    with pytest.raises((TypeError, ValueError), match="a Beam or a Blade is needed|uniform Beam"):
        function(wrong, **needed(function))


def test_there_are_as_many_as_there_are():
    """The list above is made from signatures: it must not run empty unseen."""
    assert len(OF_A_BEAM) >= 19


FLAGS = {
    "extension": lambda f: Theory(extension=f),
    "rotary inertia": lambda f: Theory(rotary_inertia=f),
    "linear_response": lambda f: linear_response(BEAM, SLOW, [1.0], foreshortening=f),
    "residual_amplitude": lambda f: residual_amplitude(BEAM, SLOW, corrected=f),
    "Variant": lambda f: Variant(name="mine", shape="rotating", axial="consistent", coriolis=f),
}


@pytest.mark.parametrize("name", FLAGS)
@pytest.mark.parametrize("wrong", ["no", "False", np.nan, 0.5, 0, None, [], np.array([True])])
def test_a_flag_is_true_or_false(name, wrong):
    """ "no" was taken for True, and so was nan."""
    with pytest.raises(TypeError, match="must be True or False, got"):
        FLAGS[name](wrong)


def test_numpys_flags_are_flags():
    assert Theory(extension=np.False_) == Theory(extension=False)


OF_A_THEORY = [
    (package, name)
    for package, name in OF_A_BEAM
    if "theory" in inspect.signature(getattr(package, name)).parameters
]


@pytest.mark.parametrize(("package", "name"), OF_A_THEORY, ids=str)
@pytest.mark.parametrize("wrong", [None, "Timoshenko", 0.3, Theory])
def test_a_theory_is_a_theory(package, name, wrong):
    function, blade = getattr(package, name), DAMPED if name == "forced_response" else STRIP
    with pytest.raises(TypeError, match=r"theory must be a Theory, got .* as Theory\(ext"):
        function(blade, **needed(function), theory=wrong)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        # Round-off gave λ_ω = -0.76 for 0.0197.
        (lambda: backbone_curve(BEAM, 6.0, 1e-6), "up_to must be at least 0.0001"),
        (lambda: stability_limit(STRIP, 6.0, largest=1e-300), "largest must be at least 0.0001"),
        (lambda: campbell(BEAM, []), "omegas must be a sequence of numbers"),
        (lambda: design_ramp(BEAM, 2.0, 5.0, modes=10**6), "modes must be at most 20"),
        (lambda: damping_ratios(DAMPED, 0.0, 200), "count must be at most 128, got 200"),
        (lambda: Blade(length=8.0, section=None), "section must be a Section, got None"),
        (
            lambda: Blade(length=8.0, section=SECTION, damping=0.01),
            "damping must be a Damping, got 0.01",
        ),
        (
            lambda: Blade(
                length=8.0, section=SECTION, point_masses=PointMass(position=1.0, mass=1.0)
            ),
            "point_masses must be several",
        ),
        (lambda: simulate(BEAM, SLOW, element=3), "element must be the name of a formulation"),
        (lambda: natural_frequencies(BEAM, 6.0, element=None), "element must be the name"),
    ],
)  # fmt: skip
def test_a_wrong_input_is_a_sentence(call, sentence):
    with pytest.raises((TypeError, ValueError), match=sentence):
        call()


def test_a_long_text_is_not_repeated_whole():
    with pytest.raises(TypeError) as refusal:
        linear_modes(BEAM, "6" * 10**6)
    assert len(str(refusal.value)) < 300


def test_as_many_modes_as_are_asked_for():
    """`damping_ratios` and `design_ramp` advised an argument `functions` that they lack."""
    damped = BEAM.with_damping(Damping(bending=1e-4))
    # ζ = η ω/2 of a bending mode at rest; the twelfth is axial, and has none.
    expected = 0.5e-4 * linear_modes(BEAM, 0.0, 11, functions=24).frequencies
    assert damping_ratios(damped, 0.0, 12) == pytest.approx([*expected, 0.0], rel=1e-3, abs=1e-12)


@pytest.mark.parametrize(
    ("made", "meant"),
    [
        (
            lambda: Beam(
                length=8.0, area=7.3e-5, second_moment=8.2e-9, youngs_modulus=68.95, density=2767.0
            ),
            "68.95 GPa are 6.895e.10 Pa",
        ),
        (
            lambda: Section(
                axial_stiffness=5.033e-3, bending_stiffness=5.66e-7, mass_per_length=0.202
            ),
            "0.005033 GN are 5.033e.06 N",
        ),
    ],
)
def test_a_stiffness_in_giga_is_told(made, meant):
    """E in GPa went through: ω_0 = 9e-5 rad/s."""
    with pytest.warns(
        RotbeamWarning, match=rf"along the beam at 0.158 m/s.*{meant} and make it 499. m/s"
    ):
        made()


@pytest.mark.parametrize(
    ("modulus", "density"),
    [(1e6, 1000.0), (68.95e3, 2.767e-9), (68.95, 2.767e-6), (6.895e11, 2.767)],
    ids=["rubber", "mm t s", "mm kg ms", "cgs"],
)
def test_rubber_and_usual_units_are_not(modulus, density):
    """Warnings are errors in this suite."""
    Beam(length=8.0, area=7.3e-5, second_moment=8.2e-9, youngs_modulus=modulus, density=density)


@pytest.mark.parametrize(("package", "name"), OF_A_BEAM, ids=str)
def test_a_twisted_blade_is_answered_in_space_or_refused(package, name):
    """Never by the answer of the straight one."""
    function = getattr(package, name)
    in_space = {
        "backbone", "backbone_curve", "campbell", "damping_ratios", "design_ramp",
        "forced_response", "linear_modes", "periodic_orbits", "quiet_ramp_times",
        "residual_amplitude", "spin_up_response", "state_space", "steady_state",
    }  # fmt: skip
    if name in in_space:
        return
    with pytest.raises(ValueError, match=r"a straight blade in its plane|uniform Beam"):
        function(STRIP.with_twist(0.5), **needed(function))
