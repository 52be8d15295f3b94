"""A TOML file with motion and numerics; the summary of a run and the exact one beside it."""

import re

import numpy as np
import pandas as pd
import pytest

import analytic
from analytic import Beam, Damping, SpinUp, TipForce
from rotbeam_exu import comparison, load, simulate
from rotbeam_exu.cli import animate
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.files.beam_file import load_run_file
from rotbeam_exu.runs.oscillation import steady_oscillation
from rotbeam_exu.verification import verify as room

RUN = """
[motion]
omega = 4
ramp_time = 2.5

[numerics]
element = "cable"
elements = 2
step = 0.01
duration = 8
frame = "rotating"
"""


@pytest.fixture
def config(tmp_path):
    path = tmp_path / "run.toml"
    path.write_text(RUN)
    return path


def test_a_file_without_a_beam_is_of_the_papers(config):
    file = load_run_file(config)
    assert file.beam == Beam.reference()
    assert file.motion == {"omega": 4.0, "ramp_time": 2.5}
    assert file.numerics["elements"] == 2


def test_motion_and_numerics_are_taken_and_options_come_first(call, tmp_path, config):
    code, out, _ = call("run", "--config", config, "--no-figure", "--out", tmp_path)
    assert code == 0
    run = load(tmp_path / "cable-2-omega-4-ramp-2.5.nc")
    attrs = {"omega": 4.0, "ramp_time": 2.5, "elements": 2, "step": 0.01, "duration": 8.0,
             "frame": "rotating", "element": "cable"}  # fmt: skip
    assert attrs.items() <= run.attrs.items()
    assert [line for line in out.splitlines() if line.startswith("written")] == [
        f"written {tmp_path}/cable-2-omega-4-ramp-2.5.{kind}" for kind in ("nc", "csv")
    ]
    given = ("--elements", "1", "--omega", "5", "--frame", "inertial", "--element", "exact")
    assert call("run", "--config", config, *given, "--no-figure", "--out", tmp_path)[0] == 0
    run = load(tmp_path / "exact-1-omega-5-ramp-2.5.nc")
    assert (run.attrs["frame"], run.attrs["step"]) == ("inertial", 0.01)


def test_the_motion_of_the_file_reaches_the_other_commands(call, config, tmp_path):
    assert "at ω = 4 rad/s" in call("backbone", "--config", config)[1]
    assert call("reference", "--config", config, "--tolerance", "1e-4", "-o", tmp_path)[0] == 0
    exact = load(tmp_path / "exact-omega-4-ramp-2.5.nc")
    assert exact["time"][-1] == 8.0
    code, _, _ = call(
        "sweep", "--config", config, "--jobs", "1", "--cache", tmp_path / "cache", "-o", tmp_path
    )
    assert code == 0
    assert dict(load(tmp_path / "sweep-cable-2.nc").sizes) == {"omega": 1, "ramp_time": 1}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[motion]\nomga = 6", "unknown key 'omga' in [motion]; did you mean 'omega'?"),
        ("[motion]\nomega = -1", "[motion]: omega must"),
        ("[motion]\nomega = '60rpm'", "omega must be a number in rad/s, got '60rpm'"),
        ("[motion]\nramp_time = 'long'", "[motion]: ramp_time must be a number"),
        ("[numerics]\nelements = 2.5", "[numerics]: elements must be a whole number"),
        ("[numerics]\nelement = 3", "[numerics]: element must be a name in quotes, got 3"),
        ("motion = 3", "write [motion] as a table"),
        ("loads = 3", 'write each [[loads]] as a table, with kind = "Gravity"'),
        ("[[loads]]\nkind = 'Storm'", "[[loads]]: 'Storm' is no known Load"),
        ("[[loads]]\nkind = 'TipForce'\nsize = 1.0", "[[loads]]: this is no TipForce"),
        ("[movement]\nomega = 6", "unknown table or key 'movement'"),
        ("", "has no table [beam]"),
    ],
)
def test_a_slip_in_the_file_is_one_sentence(call, tmp_path, text, sentence):
    path = tmp_path / "slip.toml"
    path.write_text(text)
    code, _, error = call("run", "--config", path, "--out", tmp_path)
    assert code == 2
    assert f"{path}" in error
    assert sentence in error
    assert len(error.strip().splitlines()) == 1


def test_loads_and_damping_of_the_file_and_of_options(call, config, tmp_path):
    """Options replace the file's; the frequency of a free orbit is not compared with theirs."""
    config.write_text(f"{RUN}[[loads]]\nkind = 'Gravity'\ngravity = 1.6\n")
    path = tmp_path / "cable-2-omega-4-ramp-2.5.nc"
    quiet = ("--config", config, "--no-figure", "--force", "--out", tmp_path)
    code, out, _ = call("run", *quiet)
    assert code == 0
    assert re.search(r"^loads +.*gravity of 1.6 m/s", out, re.MULTILINE)
    assert "cannot be had: loads and damping make it another" in out
    weak = load(path)
    options = ("--tip-force", "0.5", "--load-frequency", "3", "--damping-ratio", "0.01")
    assert call("run", *quiet, *options)[0] == 0
    case = RunCase.described(load(path).attrs)
    assert case.loads == (TipForce(amplitude=0.5, frequency=3.0),)
    assert case.beam.damping == Damping.from_ratio(Beam.reference(), 1, 0.01)
    swept = ("sweep", "--config", config, "--jobs", "1", "--cache", tmp_path / "cache")
    assert call(*swept, "-o", tmp_path)[0] == 0
    amplitude = steady_oscillation(weak).amplitude
    assert load(tmp_path / "sweep-cable-2.nc")["amplitude"].item() == pytest.approx(amplitude)


def test_loads_that_cannot_be_taken_are_refused(call, config, tmp_path):
    assert "with --load-frequency" in call("run", "--tip-force", "1", "-o", tmp_path)[2]
    config.write_text(f"{RUN}[[loads]]\nkind = 'Gravity'\n")
    code, _, error = call("reference", "--config", config, "-o", tmp_path)
    assert (code, "the file has [[loads]], which only run, sweep and converge" in error) == (
        2,
        True,
    )


def test_no_exact_leaves_the_exact_orbit_out(call, config, tmp_path, monkeypatch):
    monkeypatch.setattr(analytic, "periodic_orbits", None)
    quick = ("run", "--config", config, "--no-exact", "--no-figure", "--out", tmp_path)
    assert "exact ω_NL            cannot be had: it was not asked for" in call(*quick)[1]


def test_motion_is_read_or_refused(call, config, tmp_path):
    """The diagram goes to twice the speed; the Explorer has sliders."""
    modes = ("campbell", "--config", config, "--points", "2", "--count", "1", "--out", tmp_path)
    assert call(*modes)[0] == 0
    assert load(tmp_path / "campbell-given.nc")["omega"][-1] == 8.0
    code, _, error = call("explore", "--config", config, "--out", tmp_path / "page.html")
    assert (code, "leave [motion] out of the file" in error) == (2, True)


def test_an_element_or_a_frame_that_is_none_is_refused(call, config, tmp_path):
    for slip, sentence in (("cabel", "unknown element 'cabel'"), ("rotated", "unknown frame")):
        name = "element" if slip == "cabel" else "frame"
        config.write_text(f'[numerics]\n{name} = "{slip}"\nduration = 8\nstep = 0.01\nelements = 1')
        code, _, error = call("run", "--config", config, "--out", tmp_path)
        assert code == 2
        assert sentence in error


def test_the_summary_of_a_run(call, tmp_path):
    code, out, err = call(
        "run", "--elements", "8", "--step", "0.01", "--duration", "8", "--no-figure",
        "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    assert re.search(r"^verdict +checks passed$", out, re.MULTILINE)
    assert "the estimator's, without mesh and step" in out
    assert "exact ω_n             3.730401 rad/s (Bernoulli-Euler)" in out
    shown = re.search(r"error of the run's (\S+), beyond that of ω_n (\S+): the step", out)
    # Second order: a hundred times the 1.9e-5 of steps of 1 ms, and a little of the mesh.
    assert float(shown[2]) == pytest.approx(-1.9e-3, rel=0.1)
    assert "warning: the error of the mesh" in err
    assert "warning: the error of the step, and the mesh in the swing," in err


def test_the_reference_is_the_exact_spin_up(call, tmp_path):
    quick = ("--omega", "2", "--ramp-time", "4", "--duration", "6", "--samples", "7",
             "--tolerance", "1e-6")  # fmt: skip
    code, _, _ = call("reference", *quick, "-o", tmp_path)
    assert code == 0
    data = load(tmp_path / "exact-omega-2-ramp-4.nc")
    table = pd.read_csv(tmp_path / "exact-omega-2-ramp-4.csv", comment="#")
    assert np.array_equal(table["q [m]"], data["q"])
    assert np.array_equal(data["time"], np.arange(7.0))
    # 16 elements of fourth order and 1 ms: 1e-4 of the largest deflection is plenty.
    run = simulate(Beam.reference(), SpinUp(omega=2.0, ramp_time=4.0), duration=6.0, step=1e-3)
    for name in ("q", "q_dot", "tip_x", "tip_y", "angle"):
        there = np.interp(data["time"], run["time"], run[name])
        assert data[name].to_numpy() == pytest.approx(there, abs=1e-3)
    for name in ("root_force_x", "root_force_y", "root_moment_z"):
        there = np.interp(data["time"], run["time"], run[name])
        largest = np.abs(there).max()
        assert data[name].to_numpy() == pytest.approx(there, abs=1e-3 * largest)
    assert data.attrs["error"] <= 1e-6
    code, _, error = call("reference", *quick[:6], "--samples", "8", "-o", tmp_path)
    assert code == 2
    assert "samples 7 instead of 8" in error


def test_the_motion_of_the_file_is_that_of_ramp_and_stability(call, config, monkeypatch):
    """`ramp` designed for the speed it would have chosen, 6 rad/s, where the file said 4."""
    seen = []

    def stopped(_, omega, *__, **options):
        seen.append((omega, getattr(options.get("element"), "name", None), options.get("elements")))
        raise KeyboardInterrupt

    monkeypatch.setattr(comparison, "residual", stopped)
    monkeypatch.setattr(analytic, "planar_stability", stopped)
    tube = ("stability", "--section", "tube", "--amplitude", "0.02")
    for command in (("ramp",), ("ramp", "--omega", "5", "--elements", "1"), tube):
        assert call(*command, "--config", config)[0] == 130
    assert seen == [(4.0, "cable", 2), (5.0, "cable", 1), (4.0, None, None)]
    assert "--omega" in call(*tube)[2]


def test_duration_and_step_of_the_file_reach_animate_and_verify(
    call, config, tmp_path, monkeypatch
):
    def filmed(beam, spin_up, times, **_):
        raise KeyboardInterrupt(f"{times[-1]:g} {spin_up.omega:g}")

    monkeypatch.setattr(animate, "spin_up_response", filmed)
    film = ("animate", "--config", config, "--rate", "1", "--out", tmp_path / "film.gif")
    assert "8 4" in call(*film)[2]

    def stopped(entry, *, spin_up, duration, **_):
        raise KeyboardInterrupt(f"{entry.step:g} {duration:g} {spin_up.omega:g}")

    monkeypatch.setattr(room, "verify", stopped)
    assert "0.01 8 4" in call("verify", "--element", "cable", "--config", config)[2]
