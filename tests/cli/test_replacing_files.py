"""Nothing that was computed is lost: other inputs do not replace it, and failures are kept."""

import re

import pytest

import analytic
from rotbeam_exu import comparison, explorer, figures, load
from rotbeam_exu.fem import simulation
from rotbeam_exu.sweeps import grid
from rotbeam_exu.verification import verify
from tests.beams import BEAM_TOML

SHORT = ("--elements", "2", "--step", "0.01", "--duration", "8")
QUICK = ("--no-figure", "--no-exact")


def test_the_same_inputs_may_be_run_again_and_others_are_refused_first(call, tmp_path, monkeypatch):
    assert call("run", *SHORT, "--no-exact", "--out", tmp_path)[0] == 0
    assert call("run", *SHORT, *QUICK, "--out", tmp_path)[0] == 0
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    (tmp_path / "beam.toml").write_text(BEAM_TOML)
    with monkeypatch.context() as patch:
        patch.setattr(simulation, "run_case", lambda *_, **__: pytest.fail("computed first"))
        for options, sentence in (
            (("--step", "0.005"), "step 0.01 instead of 0.005"),
            (("--duration", "9"), "duration 8 instead of 9"),
            (("--frame", "rotating"), "frame inertial instead of rotating"),
            (("--omega", "6.0000001"), "omega 6 instead of 6.0000001"),
            (
                ("--config", tmp_path / "beam.toml", "--omega", "6", "--ramp-time", "3"),
                "instead of {'kind': 'Beam', 'length': 8.0, 'area': 1.0",
            ),
        ):
            arguments = dict(zip(SHORT[::2], SHORT[1::2], strict=True))
            arguments |= dict(zip(options[::2], options[1::2], strict=True))
            code, _, error = call("run", *sum(arguments.items(), ()), "--out", tmp_path)
            assert code == 2
            assert sentence in error
            assert "choose another folder with --out, or --force" in error
            assert len(error.strip().splitlines()) == 1
    assert all(path.read_bytes() == text for path, text in before.items())
    other = ("--frame", "rotating", "--force")
    assert call("run", *SHORT, *QUICK, *other, "--out", tmp_path)[0] == 0
    assert load(next(tmp_path.glob("*.nc"))).attrs["frame"] == "rotating"


def test_tables_of_other_inputs_are_not_replaced_either(call, tmp_path):
    """Of which the netCDF file is gone: their JSON file knows the inputs."""
    run = ("run", "--elements", "2", "--duration", "8", *QUICK, "--out", tmp_path)
    assert call(*run, "--step", "0.01")[0] == 0
    (tmp_path / "cable-2-omega-6-ramp-3.nc").unlink()
    code, _, error = call(*run, "--step", "0.005")
    assert code == 2
    assert "ramp-3.json holds another result: step 0.01 instead of 0.005" in error
    assert call(*run, "--step", "0.01")[0] == 0


def test_a_short_window_keeps_the_run_and_says_where_and_how_long_is_enough(call, tmp_path):
    short = ("run", *SHORT[:4], "--duration", "5", "--no-figure", "--out", tmp_path)
    code, _, error = call(*short)
    assert code == 1
    kept = tmp_path / "cable-2-omega-6-ramp-3.nc"
    assert f"the run itself is in {kept}" in error
    assert load(kept).attrs["verdict"] == "passed"
    assert kept.with_suffix(".csv").exists()
    enough = float(re.search(r"run for (\S+) s or longer", error)[1])
    long = ("--duration", round(enough + 0.005, 2), "--force", "--no-exact")
    assert call(*short[:5], *long, *short[-3:])[0] == 0


def test_a_failed_run_is_kept_and_marked(call, tmp_path):
    failing = ("run", "--elements", "2", "--step", "0.08", "--ramp-time", "2.5", "--no-figure",
               "--out", tmp_path)  # fmt: skip
    code, _, error = call(*failing, "--duration", "8")
    assert code == 1
    kept = tmp_path / "cable-2-omega-6-ramp-2.5-failed.nc"
    assert f"the part that was computed is in {kept}, marked failed" in error
    assert load(kept).attrs["verdict"].startswith("failed: ")
    # And where nothing failed, nothing is in the way.
    assert call("run", *SHORT, *QUICK, "--ramp-time", "2.5", "--out", tmp_path)[0] == 0


def test_a_sweep_does_not_replace_another_grid(call, tmp_path, monkeypatch):
    def swept(*options):
        return call(
            "sweep", *SHORT, "--jobs", "1", "--cache", tmp_path / "cache", "--out", tmp_path,
            *options,
        )  # fmt: skip

    assert swept("--omega", "6", "--ramp-time", "3")[0] == 0
    assert swept("--omega", "6", "--ramp-time", "3")[0] == 0
    with monkeypatch.context() as patch:
        patch.setattr(grid, "sweep", lambda *_, **__: pytest.fail("computed first"))
        code, _, error = swept("--omega", "5", "--ramp-time", "3")
        assert code == 2
        assert "sweep-cable-2.nc holds another result: omega" in error
    assert swept("--omega", "5", "--ramp-time", "3", "--force")[0] == 0


def stopped(*_, **__):
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    ("command", "room", "name"),
    [
        ("sweep", grid, "sweep"), ("explore --config beam.toml", explorer, "explorer_data"),
        ("compare", comparison, "figure_14"), ("verify --element cable", verify, "verify"),
        ("reference", analytic, "spin_up_response"),
    ],
)  # fmt: skip
def test_ctrl_c_says_what_is_kept_or_that_nothing_is(
    call, tmp_path, monkeypatch, command, room, name
):
    monkeypatch.setattr(room, name, stopped)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "beam.toml").write_text(BEAM_TOML)
    kept = "nothing was written"
    if command.split()[0] in ("sweep", "explore", "compare"):
        command, kept = f"{command} --cache c", "finished spin-ups are kept in the cache c"
    assert call(*command.split())[::2] == (130, f"rotbeam: interrupted; {kept}\n")


@pytest.mark.parametrize(
    ("command", "drawing", "name"),
    [
        (
            "ramp --omega 2 --longest 3 --points 0 --finite-element-points 0",
            "residual", "ramp-omega-2-longest-3",
        ),
        ("figure 8", "figure_8", "figure_8"),
    ],
)  # fmt: skip
def test_ctrl_c_while_a_figure_is_drawn_says_where_its_data_is(
    call, tmp_path, monkeypatch, command, drawing, name
):
    monkeypatch.setattr(figures, drawing, stopped)
    code, _, error = call(*command.split(), "--out", tmp_path)
    assert code == 130
    assert f"kept: {tmp_path}/{name}.nc, {tmp_path}/{name}" in error
    assert all(str(path) in error for path in tmp_path.iterdir())


@pytest.mark.parametrize("command", ["animate", "explore"])
def test_a_picture_or_a_page_of_someone_else_is_not_replaced(call, tmp_path, command):
    target = tmp_path / ("mine.gif" if command == "animate" else "mine.html")
    target.write_text("mine")
    code, _, error = call(command, "--out", target)
    assert code == 2
    assert f"{target} is there" in error
    assert target.read_text() == "mine"
