"""What --help says: every command in a line, in the order of the work, and no flag of no use."""

import re

from rotbeam_exu.cli import _COMMANDS


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
