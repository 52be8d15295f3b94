"""What --help says: every command in a line, in the order of the work, and no flag of no use."""

import re

import pytest

from analytic import VARIANTS
from rotbeam_exu.cli import _COMMANDS
from rotbeam_exu.fem.elements import ALIASES, FORMULATIONS
from rotbeam_exu.verification.peers import PEERS


def test_each_command_has_one_line_at_eighty_columns(call, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    _, out, _ = call("--help")
    listed = re.findall(r"^│ ([a-z]+) {2,}(\S.*\S) +│$", out, re.MULTILINE)
    assert tuple(name for name, _ in listed) == _COMMANDS
    assert all(summary.endswith(".") for _, summary in listed)


def test_no_command_offers_an_empty_or_a_negative_flag(call):
    for command in _COMMANDS:
        code, out, _ = call(command, "--help")
        assert code == 0
        assert "--empty-" not in out
        assert "--no-" not in out.replace("--no-figure", "")


def test_every_option_is_described_and_every_name_listed(call, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    for command in _COMMANDS:
        out = call(command, "--help")[1]
        described = re.findall(
            r"^│ \*? *(--[a-z-]+|[A-Z]+ --[a-z]+)\b.*? {2,}(\S.*?) *│$", out, re.M
        )
        options = re.findall(r"^│ \*? *(?:--[a-z-]+|[A-Z]+ --[a-z]+)", out, re.M)
        assert len(described) == len(options)
        for name, text in described:
            assert not text.startswith("["), (command, name)
    for command, names in (
        ("run", [*FORMULATIONS, *ALIASES]),
        ("sweep", [*FORMULATIONS, *ALIASES]),
        ("verify", [*FORMULATIONS, *ALIASES, *PEERS]),
        ("backbone", VARIANTS),
    ):
        words = set(re.findall(r"\w+", call(command, "--help")[1]))
        assert set(names) <= words


def test_defaults_are_shown_as_they_are_typed(call):
    for command in _COMMANDS:
        out = call(command, "--help")[1]
        for odd in ("default: False", "default: [", "BOOL"):
            assert odd not in out, command
    assert "--gravity [FLOAT]" in call("respond", "--help")[1]


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        (("respond", "--to", "2"), "--from"),
        (("figure",), "NUMBER"),
        (("run", "--omega"), "--omega"),
    ],
)
def test_what_is_missing_is_named_and_where_it_is_explained(call, arguments, name):
    code, _, error = call(*arguments)
    assert code == 2
    assert f"{name} requires an argument. rotbeam {arguments[0]} --help explains it" in error


def test_names_are_known_in_upper_and_lower_case(call):
    arguments = ("backbone", "--omega", "6", "--amplitude", "0.1", "--format", "csv", "--variant")
    assert call(*arguments, "frm")[1] == call(*arguments, "FrM")[1]
    assert call("verify", "--element", "CABEL")[0] == 2
    code, _, error = call(*arguments, "frn")
    assert code == 2
    assert "rotbeam: frn: variant must be one of CI, CE" in error
    assert call("backbone", "--omega", "6", "--format", "text")[0] == 2
