"""A TOML file with motion and numerics; the summary of a run and the exact one beside it."""

import re

import numpy as np
import pandas as pd
import pytest

import analytic
from analytic import Beam, Damping, Gravity, SpinUp, TipForce
from rotbeam_exu import comparison, load, simulate
from rotbeam_exu.cli import animate
from rotbeam_exu.fem import simulation
from rotbeam_exu.fem.elements import Exact
from rotbeam_exu.sweeps import grid
from rotbeam_exu.verification import verify as room_of_verify

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


@pytest.fixture
def reached(reached, config, tmp_path, monkeypatch):
    """Commands that are given the file."""
    monkeypatch.chdir(tmp_path)
    return lambda *command: reached(*command, "--config", config)


def test_motion_and_numerics_are_taken_and_options_come_first(call, tmp_path, config, reached):
    quick = ("--no-exact", "--no-figure", "--out", tmp_path)
    code, out, _ = call("run", "--config", config, *quick)
    assert code == 0
    assert "exact ω_NL            cannot be had: it was not asked for" in out
    run = load(tmp_path / "cable-2-omega-4-ramp-2.5.nc")
    attrs = {"omega": 4.0, "ramp_time": 2.5, "elements": 2, "step": 0.01, "duration": 8.0,
             "frame": "rotating", "element": "cable"}  # fmt: skip
    assert attrs.items() <= run.attrs.items()
    assert [line for line in out.splitlines() if line.startswith("written")] == [
        f"written {tmp_path}/cable-2-omega-4-ramp-2.5.{kind}" for kind in ("nc", "csv", "json")
    ]
    given = ("--elements", "1", "--omega", "5", "--frame", "inertial", "--element", "exact")
    (case,), _ = reached(simulation, "run_case", "run", *given)
    assert case.element == Exact()
    assert (case.elements, case.omega, case.ramp_time) == (1, 5.0, 2.5)
    assert (case.frame, case.step) == ("inertial", 0.01)


def test_the_file_reaches_the_other_commands(call, config, reached):
    """`ramp` designed for the speed it would have chosen, 6 rad/s, where the file said 4."""
    for room, command in ((analytic, "reference"), (animate, "animate")):
        (beam, spin_up, times), _ = reached(room, "spin_up_response", command)
        assert (beam, spin_up) == (Beam.reference(), SpinUp(omega=4.0, ramp_time=2.5))
        assert times[-1] == 8.0
    _, options = reached(grid, "sweep", "sweep")
    assert (options["omegas"], options["ramp_times"]) == ([4.0], [2.5])
    assert (options["frame"], options["elements"]) == ("rotating", 2)
    for more, omega, elements in (((), 4.0, 2), (("--omega", "5", "--elements", "1"), 5.0, 1)):
        (_, speed), options = reached(comparison, "residual", "ramp", *more)
        assert (speed, options["elements"]) == (omega, elements)
        assert options["element"].name == "cable"
    (entry,), options = reached(room_of_verify, "verify", "verify", "--element", "cable")
    assert (entry.step, options["duration"], options["spin_up"].omega) == (0.01, 8.0, 4.0)
    # Of the theory, which has no elements.
    config.write_text(RUN.partition("[numerics]")[0])
    assert "at ω = 4 rad/s" in call("backbone", "--config", config)[1]
    tube = ("stability", "--section", "tube", "--amplitude", "0.02")
    assert reached(analytic, "stability_limit", *tube)[0][1] == 4.0
    assert "--omega" in call(*tube)[2]
    # The diagram goes to twice the speed; the Explorer has sliders.
    assert reached(analytic, "campbell", "campbell")[0][1][-1] == 8.0


def test_loads_and_damping_of_the_file_and_of_options(call, config, tmp_path, reached):
    """Options replace the file's; the frequency of a free orbit is not compared with theirs."""
    config.write_text(f"{RUN}[[loads]]\nkind = 'Gravity'\ngravity = 1.6\n")
    code, out, _ = call("run", "--config", config, "--no-figure", "--out", tmp_path)
    assert code == 0
    assert re.search(r"^loads +.*gravity of 1.6 m/s", out, re.MULTILINE)
    assert "cannot be had: loads and damping make it another" in out
    options = ("--tip-force", "0.5", "--load-frequency", "3", "--damping-ratio", "0.01")
    (case,), _ = reached(simulation, "run_case", "run", *options, "--force")
    assert case.loads == (TipForce(amplitude=0.5, frequency=3.0),)
    assert case.blade.damping == Damping.from_ratio(Beam.reference(), 1, 0.01)
    assert reached(grid, "sweep", "sweep")[1]["loads"] == (Gravity(1.6),)


def test_the_summary_of_a_run(call, tmp_path):
    code, out, err = call(
        "run", "--elements", "8", "--step", "0.01", "--duration", "8", "--no-figure",
        "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    verdict = re.search(r"^verdict +equations solved; mesh too coarse, (\S+) %$", out, re.MULTILINE)
    assert "(fit only; mesh and step not included)" in out
    assert "exact ω_n             3.730401 rad/s (lag 1, Bernoulli-Euler)" in out
    shown = re.search(
        r"error (\S+) in total; relative to ω_n of this mesh (\S+) \(step and mesh\)", out
    )
    assert float(verdict[1]) / 100.0 == pytest.approx(float(shown[1]), rel=0.1)
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
    table = pd.read_csv(tmp_path / "exact-omega-2-ramp-4.csv")
    assert np.array_equal(table["q [m]"], data["q"])
    assert np.array_equal(data["time"], np.arange(7.0))
    # 8 elements of fourth order and 2 ms: 1e-4 of the largest deflection is plenty.
    motion = SpinUp(omega=2.0, ramp_time=4.0)
    run = simulate(Beam.reference(), motion, elements=8, duration=6.0, step=2e-3)
    loads = ("root_force_x", "root_force_y", "root_moment_z")
    for name in ("q", "q_dot", "tip_x", "tip_y", "angle", *loads):
        there = np.interp(data["time"], run["time"], run[name])
        largest = np.abs(there).max() if name in loads else 1.0
        assert data[name].to_numpy() == pytest.approx(there, abs=1e-3 * largest)
    assert data.attrs["error"] <= 1e-6
    code, _, error = call("reference", *quick[:6], "--samples", "8", "-o", tmp_path)
    assert code == 2
    assert "samples 7 instead of 8" in error
