"""Tables of a run's file: each command uses or refuses each, and none executes code of a file."""

import inspect
import re
import sys
from typing import get_args

import pytest

import analytic
from rotbeam_exu import comparison, explorer
from rotbeam_exu.cli import _COMMANDS, animate, app
from rotbeam_exu.cli import request as room
from rotbeam_exu.cli.job import Results
from rotbeam_exu.fem.elements import FORMULATIONS
from rotbeam_exu.files.beam_tables import _DOCUMENT
from rotbeam_exu.runs import Element
from rotbeam_exu.verification import verify

TABLES = {
    "motion": "[motion]\nomega = 4\nramp_time = 2.5\n",
    "numerics": "[numerics]\nelement = 'cable'\nelements = 2\nstep = 0.01\nduration = 8\n"
    "frame = 'rotating'\ntolerance = 1e-4\n",
    "theory": "[theory]\nextension = true\nshear = 0.3\nengesser = false\n"
    "rotary_inertia = true\ntrapeze = false\n",
    "loads": "[[loads]]\nkind = 'Gravity'\n",
    "uncertainty": "[uncertainty]\nEI3 = 0.1\n",
}  # fmt: skip
REQUIRED = {
    "backbone": "--exact",
    "respond": "--from 3 --to 4 --tip-force 1 --damping-ratio 0.1", "stability": "--section tube",
    "report": "-o out", "fit": "measured.csv --free EI3",
}  # fmt: skip
COMMANDS = [
    name
    for name in _COMMANDS
    if "config" in inspect.signature(app[name].default_command).parameters
]


class Noted(dict):
    """Numbers and names that note which of them are read."""

    def __init__(self, numbers, read):
        super().__init__(numbers)
        self.read = read

    def __getitem__(self, key):
        self.read.add(key)
        return super().__getitem__(key)

    def get(self, key, *default):
        self.read.add(key)
        return super().get(key, *default)


class NotedRequest(room.Request):
    """The request of a command that notes in `read` what is taken of it."""

    read: set

    def __getattribute__(self, name):
        if name in ("theory", "loads", "uncertainty"):
            self.read.update(getattr(_DOCUMENT.optional[name], "optional", [name]))
        return super().__getattribute__(name)


def stopped(*_, **__):
    raise KeyboardInterrupt


def test_every_table_is_tried():
    assert {*TABLES, "beam", "blade"} == _DOCUMENT.optional.keys()
    assert {"run", "sweep", "backbone", "verify"} <= {*COMMANDS}


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_uses_or_names_all_of_a_table(call, tmp_path, monkeypatch, command, table):
    known, read = room._request, set()

    def noted(*given):
        request = vars(known(*given))
        return NotedRequest(**{**request, "values": Noted(request["values"], read)})

    monkeypatch.setattr(NotedRequest, "read", read, raising=False)
    monkeypatch.setattr(room, "_request", noted)
    for place, name in (
        (Results, "job"), (analytic, "campbell"), (analytic, "reduced_model"),
        (animate, "spin_up_response"), (verify, "verify"), (comparison, "figure_14"),
        (explorer, "explorer_data"),
    ):  # fmt: skip
        monkeypatch.setattr(place, name, stopped)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run.toml").write_text(TABLES[table])
    arguments = REQUIRED.get(command, "").split()
    (tmp_path / "measured.csv").write_text("mode,frequency [Hz]\n1,0.5\n")
    # These come after the speed that commands need.
    if arguments and command != "fit" and table != "motion":
        arguments += ["--omega", "4"]
    code, _, error = call(command, *arguments, "--config", "run.toml")
    assert code in (0, 130), error
    keys = getattr(_DOCUMENT.optional[table], "optional", [table])
    named = re.findall(r"\w+", error.partition("does not use ")[2].partition(" of [")[0])
    named += ["uncertainty"] * ("EI3" in named)
    whole = table != "motion" or not read & {*keys}  # of a motion a command may use the speed alone
    assert not whole or {*keys} - {*named} <= read


@pytest.fixture
def strange(tmp_path, monkeypatch):
    """A folder with a stranger's module, whose code leaves a file."""
    (tmp_path / "evil.py").write_text(
        "from pathlib import Path\nPath('IMPORTED').touch()\n"
        "def Foo():\n    Path('CALLED').touch()\n"
    )
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    yield tmp_path
    sys.modules.pop("evil", None)


@pytest.mark.parametrize("name", ["evil:Foo", "os:abort", "evil.Foo", "", "cable:"])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_file_executes_nothing(call, strange, command, name):
    (strange / "beam.toml").write_text(f"[numerics]\nelement = '{name}'\n")
    arguments = REQUIRED.get(command, "").split()
    code, out, error = call(command, *arguments, "--config", "beam.toml")
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert f"unknown element '{name}' in [numerics]; known are 'cable', " in error
    assert not (strange / "IMPORTED").exists()
    assert "evil" not in sys.modules


def test_a_file_may_name_each_formulation_there_is():
    assert get_args(Element) == tuple(FORMULATIONS)


@pytest.mark.parametrize("command", ["run", "converge", "sweep", "ramp", "verify"])
@pytest.mark.parametrize("name", ["evil:Foo", "os:abort", "fractions:Fraction"])
def test_what_is_no_formulation_is_not_called(call, strange, command, name):
    code, _, error = call(command, "--element", name)
    assert (code, error.count("\n")) == (2, 1)
    assert f"no element can be made of {name}: it is no class that inherits" in error
    assert not (strange / "CALLED").exists()


def test_a_module_in_the_folder_hides_no_other(call, strange):
    """As a stranger's random.py would."""
    (strange / "colorsys.py").write_text("import pathlib\npathlib.Path('IMPORTED').touch()\n")
    sys.modules.pop("colorsys", None)
    assert "has no attribute 'Foo'" in call("run", "--element", "colorsys:Foo")[2]
    assert not (strange / "IMPORTED").exists()
