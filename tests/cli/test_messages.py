"""A warning once per command, whatever its numbers; the rest is counted."""

import warnings

import pytest

from analytic.input_checks import RotbeamWarning
from rotbeam_exu.cli import backbone as job
from rotbeam_exu.cli.endings import Messages


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
