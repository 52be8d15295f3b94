"""Text that a terminal cannot encode is spelled; paths are printed as they are."""

import io
import os
import subprocess
import sys

import pytest

from rotbeam_exu.cli.output import ready_streams


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("ascii", "omega_NL Omega +- x m^2 theta lambda ... - ? ? ?"),
        ("latin-1", "omega_NL Omega ± × m² theta lambda ... - é ? ?"),
        # Of a pipe or a file on Windows.
        ("cp1252", "omega_NL Omega ± × m² theta lambda … - é ? ?"),
        ("utf-8", "ω_NL Ω ± × m² ϑ λ … − é 中 ?"),
    ],
)
def test_letters_are_spelled_where_they_must_be(monkeypatch, encoding, shown):
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding=encoding)
    monkeypatch.setattr(sys, "stdout", stream)
    ready_streams()
    stream.write("ω_NL Ω ± × m² ϑ λ … − é 中 \udcff")
    stream.flush()
    assert raw.getvalue().decode(encoding) == shown


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    [
        ("backbone", "--omega", "6"),
        ("campbell", "--points", "2", "--count", "1", "--orders", "1"),
        ("table", "5"),
        ("doctor",),
        ("run", "--help"),
        ("verify", "--element", "ω"),
    ],
)
def test_every_command_speaks_ascii(command):
    env = {**os.environ, "LC_ALL": "POSIX", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    done = subprocess.run(
        [sys.executable, "-m", "rotbeam_exu.cli", *command],
        capture_output=True,
        env=env,
        check=False,
    )
    assert b"Traceback" not in done.stderr
    assert done.returncode == (2 if "verify" in command else 0)
    (done.stdout + done.stderr).decode("ascii")


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
