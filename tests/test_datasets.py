"""Every kind of result as a Dataset and as tidy tables."""

import inspect
import math

import numpy as np
import pytest
import xarray as xr

import analytic
import rotbeam_exu
from analytic import Beam, Blade, Damping, Rectangle, Section, SpinUp, Theory, TipForce
from analytic.exact.free.stability_limit import StabilityLimit, Tongue
from analytic.sensitivity import MeasuredFrequency, fit, sensitivity
from rotbeam_exu import dataset_of, load, save, steady_oscillation
from rotbeam_exu.datasets import _described, frames_of

BEAM = Beam.reference()
STRIP = BEAM.with_shape(Rectangle())
SECTION = Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0)
TWISTED = Blade(length=1.0, section=SECTION).with_section_out_of_plane(0.0625, 0.08).with_twist(0.3)
TIMES = np.linspace(0.0, 0.25, 5)
MOTION = SpinUp(omega=1.0, ramp_time=1.0)


def oscillating():
    time = np.linspace(0.0, 20.0, 1001)
    q = xr.DataArray(2.0 * np.sin(3.7 * time), dims="time", coords={"time": time})
    return steady_oscillation(xr.Dataset({"q": q}, attrs={"ramp_time": 0.0, "blade_length": 8.0}))


def spun(blade):
    return analytic.spin_up_response(blade, MOTION, TIMES, tolerance=1e-3)


def limit():
    tongue = Tongue(low=0.1, high=0.2, growth=1e-3, kind="divergence", modes=("flap 1",))
    return StabilityLimit(
        blade=STRIP, omega=6.0, mode="lag 1", damping=0.0, theory=Theory(), growth=1e-2,
        amplitude=np.inf, searched=0.3, kind="", modes=(), tongues=(tongue,), converged=True,
    )  # fmt: skip


def branch():
    return analytic.backbone(BEAM, 6.0, theory=Theory(extension=False)).branch(up_to=0.1)


def forced(blade, omega, frequencies):
    damped = blade.with_damping(Damping(external=0.2 * blade.mass_per_length))
    return analytic.forced_response(
        damped, omega, TipForce(amplitude=1e-3), frequencies, functions=8
    )


MADE = {
    "Orbits": lambda: analytic.periodic_orbits(BEAM, 6.0, [0.1, 0.2]),
    "BackboneBranch": branch,
    "LeavingBranch": lambda: (
        analytic.backbone(BEAM.with_section_out_of_plane(0.9, 0.8), 0.0, functions=8)
        .leaving(0.3, 0.4, points=3)
    ),
    "BackboneCurve": lambda: analytic.backbone_curve(BEAM, 6.0, up_to=0.1),
    "LinearModes": lambda: analytic.linear_modes(BEAM, 6.0),
    "Fit": lambda: fit(BEAM, [MeasuredFrequency(mode="lag 1", value=3.0)], ["EI3"]),
    "Sensitivity": lambda: sensitivity(analytic.linear_modes(BEAM, 6.0)),
    "SteadyState": lambda: analytic.steady_state(TWISTED, 1.0),
    "StateSpace": lambda: analytic.state_space(TWISTED, 1.0, [TipForce(amplitude=1.0)], modes=2),
    "LinearResponse": lambda: analytic.linear_response(BEAM, MOTION, TIMES),
    "QuietRamps": lambda: analytic.quiet_ramp_times(BEAM, 2.0, longest=4.4, tolerance=1e-3),
    "SteadyOscillation": oscillating,
    "PaperTable": lambda: analytic.paper_table(5),
    "SpinUpResponse": lambda: spun(BEAM),
    "ForcedResponse": lambda: forced(BEAM, 6.0, [3.7, 3.8]),
    "GrowthOutOfPlane": lambda: analytic.periodic_orbits(STRIP, 6.0, [0.02, 0.05]).out_of_plane(),
    "StabilityLimit": limit,
    "Campbell": lambda: analytic.campbell(BEAM, [0.0, 6.0], 2),
    "SectionLoads": lambda: analytic.periodic_orbits(BEAM, 6.0, [0.1]).section_loads(
        0, [0.0, 4.0], [0.0]
    ),
}  # fmt: skip
# What is computed when it is asked, and inputs.
IN_SPACE = {
    "LinearModes": lambda: analytic.linear_modes(TWISTED, 1.0),
    "Orbits": lambda: analytic.periodic_orbits(TWISTED, 1.0, [0.02]),
    "SpinUpResponse": lambda: spun(TWISTED),
    "ForcedResponse": lambda: forced(TWISTED, 1.0, [3.4, 3.6]),
}
_LONG = IN_SPACE["ForcedResponse"], MADE["LeavingBranch"]
NO_RESULTS = {"Backbone", "FourierRamp", "ReducedModel", "FloatArray", "float | FloatArray", "Any"}
NO_RESULTS |= {"Path", "Callable[[FloatArray], BladeState]", "xr.Dataset"}


def test_no_result_of_a_public_function_is_without():
    functions = [
        function
        for package in (analytic, rotbeam_exu)
        for function in map(package.__getattr__, package.__all__)
        if inspect.isfunction(function)
    ]
    returned = {str(function.__annotations__["return"]) for function in functions}
    assert returned - NO_RESULTS <= MADE.keys()
    described = {kind.__name__ for kind in _described.registry if kind is not object}
    assert described == MADE.keys()
    with pytest.raises(TypeError, match="no Dataset is known of a float"):
        dataset_of(1.0)


@pytest.mark.parametrize(
    ("kind", "made"),
    [
        pytest.param(
            kind,
            made,
            marks=pytest.mark.slow if made in _LONG else (),
        )
        for kind, made in (*MADE.items(), *IN_SPACE.items())
    ],
)
def test_a_result_is_labeled_saved_and_tidy(kind, made, tmp_path):
    result = made()
    assert type(result).__name__ == kind
    data = dataset_of(result)
    assert data.data_vars
    for name, variable in data.data_vars.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
        assert "[" not in variable.attrs["long_name"], name
    assert load(save(data, tmp_path / "result.nc")).identical(data)
    frames = frames_of(result)
    for name, variable in data.data_vars.items():
        (frame,) = (one for one in frames.values() if name in one)
        # A row for each number, beside its place.
        assert frame[name].size == variable.size
        assert {*variable.dims} <= {*frame}
        np.testing.assert_array_equal(frame[name], variable.to_numpy().ravel())
        assert frame.attrs[name] == variable.attrs["units"]


def test_columns_are_the_result_s():
    """Numbers of one kind, at the place that its dims say."""
    found = MADE["Orbits"]()
    frames = frames_of(found)
    assert [*frames] == ["amplitude", "sine"]
    row = frames["sine"].query("orbit == 1 and harmonic == 3")
    assert row["sine"].item() == found.harmonics[1, 2]
    assert frames_of(oscillating())["amplitude"]["frequency"].item() == pytest.approx(3.7)


def of_orbits():
    """Results about orbits, of a theory that is not the usual one."""
    how = {"theory": Theory(rotary_inertia=True, trapeze=False)}
    strip = BEAM.with_shape(analytic.Rectangle())
    of = analytic.backbone(BEAM, 6.0, **how)
    yield "orbits", of.orbits([0.05])
    yield "curve", of.curve(up_to=0.1)
    yield "branch", of.branch(up_to=0.1)
    yield "stability", analytic.periodic_orbits(strip, 6.0, [0.05], **how).out_of_plane()
    yield "limit", analytic.stability_limit(strip, 6.0, largest=0.05, **how)


@pytest.mark.parametrize(
    ("results", "sentence"),
    [
        ([lambda w=w: analytic.linear_modes(BEAM, w) for w in (2.0, 6.0)], "omega, 2.0 and 6.0"),
        (
            [
                lambda: analytic.linear_modes(BEAM, 2.0),
                lambda: analytic.periodic_orbits(BEAM, 6.0, 0.1),
            ],
            "omega, 2.0 and 6.0",
        ),
        ([lambda R=R: spun(BEAM.with_hub_radius(R)) for R in (1.0, 2.0)], "blade, "),
        (
            [lambda n=n: analytic.linear_modes(BEAM, 2.0, n) for n in (2, 3)],
            "error, ",
        ),
    ],
)
def test_results_that_differ_make_no_dataset(results, sentence):
    """Not even where all but one number is the same: the first would be lost."""
    with pytest.raises(ValueError, match=rf"two results differ in .*{sentence}.*for each"):
        dataset_of(*(result() for result in results))


def test_one_result_twice_is_one():
    found = analytic.linear_modes(BEAM, 2.0)
    assert dataset_of(found, found).identical(dataset_of(found))


def test_a_file_says_of_which_theory_and_load_an_answer_is(tmp_path):
    """Also where the theory's shear is the truth value that a table of stations takes."""
    table = Blade.from_stations(
        [0.0, 1.0], [[1e4, 3e3, 3e3, 0.08, 0.06, 1.0]] * 2, [[1.0, 1e-3, 1e-3, 1e-3]] * 2
    )
    sheared = Theory(shear=True, trapeze=False)
    lifted = {"force": (0.0, 0.0, 0.01), "gravity": 0.02}
    spun_up = analytic.spin_up_response(table, MOTION, TIMES, tolerance=1e-2, theory=sheared)
    for name, found, told in (
        ("spin-up", spun_up, {"shear": 1, "trapeze": 0}),
        ("steady", analytic.steady_state(TWISTED, 1.0, **lifted), lifted),
        ("modes", analytic.linear_modes(table, 1.0, theory=sheared), {"shear": 1, "trapeze": 0}),
        *((name, found, {"rotary_inertia": 1, "trapeze": 0}) for name, found in of_orbits()),
    ):
        save(dataset_of(found), tmp_path / f"{name}.nc")
        attrs = load(tmp_path / f"{name}.nc").attrs
        for key, value in told.items():
            assert attrs[key] == pytest.approx(value), name
        assert "extension" not in attrs


def test_a_set_blade_has_the_loads_of_its_plane_in_the_axes_of_the_clamp():
    """Tension, Q and M of the section at the root; the data say that nothing else is computed."""
    blade, psi = BEAM.with_setting_angle(0.7), 0.7
    found = spun(blade)
    root, data = found.section_loads([0.0]), dataset_of(found)
    (N, Q, none), M = root.force[:, 0].T, root.moment[:, 0, 2]
    c, s = math.cos(psi), math.sin(psi)
    expected = {
        "root_force_x": N, "root_force_y": c * Q, "root_force_z": s * Q,
        "root_moment_x": none, "root_moment_y": -s * M, "root_moment_z": c * M,
    }  # fmt: skip
    for name, component in expected.items():
        np.testing.assert_allclose(data[name], component, atol=1e-14 * np.abs(M).max())
    assert not none.any()
    assert "not computed" in data.attrs["section_out_of_plane"]
    assert "section_out_of_plane" not in dataset_of(spun(TWISTED)).attrs


@pytest.mark.parametrize("result", ["SpinUpResponse", "SectionLoads"])
def test_variables_and_dims_are_those_of_a_blade_in_space(result):
    planar, in_space = (
        {name: one.dims for name, one in dataset_of(of).variables.items()}
        for of in (
            (spun(one) if result == "SpinUpResponse" else spun(one).section_loads([0.0, 1.0]))
            for one in (BEAM, TWISTED)
        )
    )
    assert planar == in_space


def test_root_loads_are_in_the_axes_of_the_clamp_as_a_run_s():
    """However a round section is set, which changes nothing else."""
    round_blade = TWISTED.with_twist(0.0).with_section_out_of_plane(1.0, 0.8).with_precone(0.1)
    level, turned = (dataset_of(spun(round_blade.with_setting_angle(psi))) for psi in (0.0, 0.7))
    for name in ("root_force_y", "root_force_z", "root_moment_y", "root_moment_z"):
        largest = abs(level[name]).max().item()
        np.testing.assert_allclose(turned[name], level[name], atol=1e-9 * largest)
