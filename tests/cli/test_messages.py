"""A warning once per command, whatever its numbers; texts and paths are printed as they are."""

import io
import sys
import warnings

import pytest

from analytic.input_checks import RotbeamWarning
from rotbeam_exu.cli import backbone as job
from rotbeam_exu.cli.endings import Messages
from rotbeam_exu.cli.output import ready_streams


def test_warnings_that_differ_in_numbers_or_in_the_model_are_one(capsys):
    messages = Messages()
    for text in (
        "30 rad/s is 4.05 times what CI leaves out",
        "30 rad/s is 4.05 times what CI leaves out",  # the same again is not even counted
        "31 rad/s is 4.1e+00 times what FrM5 leaves out",
        "the mesh is coarse",
    ):
        messages.warn(text)
    messages.count()
    messages.count()
    assert capsys.readouterr().err.splitlines() == [
        "warning: 30 rad/s is 4.05 times what CI leaves out",
        "warning: the mesh is coarse",
        "warning: 1 more like it, with other numbers: 30 rad/s is 4.05 times what CI leaves out",
    ]


def test_eighteen_warnings_of_a_command_are_two_lines(call, monkeypatch):
    def eager(*_, **__):
        for speed in range(18):
            warnings.warn(f"ω = {speed} rad/s is fast", RotbeamWarning, stacklevel=2)

    monkeypatch.setattr(job, "_print_coefficients", eager)
    code, _, error = call("backbone", "--omega", "6")
    assert code == 0
    assert error.splitlines() == [
        "warning: ω = 0 rad/s is fast",
        "warning: 17 more like it, with other numbers: ω = 0 rad/s is fast",
    ]


@pytest.mark.parametrize("failure", [ValueError("no"), RuntimeError("no")])
def test_they_are_counted_ahead_of_the_reason_of_a_failure(call, monkeypatch, failure):
    def failing(*_, **__):
        warnings.warn("1 is small", RotbeamWarning, stacklevel=2)
        warnings.warn("2 is small", RotbeamWarning, stacklevel=2)
        raise failure

    monkeypatch.setattr(job, "_print_coefficients", failing)
    code, _, error = call("backbone", "--omega", "6")
    assert code == (2 if isinstance(failure, ValueError) else 1)
    assert [line[:12] for line in error.splitlines()] == [
        "warning: 1 i",
        "warning: 1 m",
        "rotbeam: no",
    ]


@pytest.mark.parametrize("name", ["a [red] b", "[/]", "a :smile: b", "[link=x]y"])
def test_paths_in_errors_are_no_markup(call, tmp_path, name):
    code, _, error = call("run", "--config", tmp_path / f"{name}.toml")
    assert code == 2
    assert f"{name}.toml" in error


def test_paths_in_results_are_no_markup(call, tmp_path):
    out = tmp_path / "a [red] [bold] :smile:"
    short = ("--elements", "1", "--step", "0.01", "--duration", "8", "--no-figure")
    code, printed, _ = call("run", *short, "--out", out)
    assert code == 0
    assert f"{out}/cable-1-omega-6-ramp-3.nc" in printed


def test_pipes_and_files_of_windows_take_every_letter(monkeypatch):
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="cp1252"))
    ready_streams()
    sys.stdout.write("ω_NL ± λ \udcff")
    sys.stdout.flush()
    assert raw.getvalue().decode("utf-8") == "ω_NL ± λ ?"
