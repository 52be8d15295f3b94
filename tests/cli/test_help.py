"""What --help says: every command in a line, in the order of the work, and no flag of no use."""

import re

from analytic import VARIANTS
from rotbeam_exu.cli import _COMMANDS, documented
from rotbeam_exu.fem.elements import FORMULATIONS


def test_each_command_has_one_line_at_eighty_columns(call, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    _, out, _ = call("--help")
    listed = re.findall(r"^│ ([a-z]+) {2,}(\S.*\S) +│$", out, re.MULTILINE)
    assert tuple(name for name, _ in listed) == tuple(_COMMANDS)
    assert all(summary.endswith(".") for _, summary in listed)


def test_the_help_of_each_command(call, monkeypatch):
    """No flag of no use; each option described, with its default as it is typed; all examples."""
    monkeypatch.setenv("COLUMNS", "200")
    helps = {command: call(command, "--help") for command in _COMMANDS}
    for command, (code, out, _) in helps.items():
        assert code == 0
        for odd in ("--empty-", "default: False", "default: [", "BOOL"):
            assert odd not in out, command
        assert "--no-" not in re.sub("--no-(figure|exact)", "", out)
        described = re.findall(
            r"^│ \*? *(--[a-z-]+|[A-Z]+ --[a-z]+)\b.*? {2,}(\S.*?) *│$", out, re.M
        )
        options = re.findall(r"^│ \*? *(?:--[a-z-]+|[A-Z]+ --[a-z]+)", out, re.M)
        assert len(described) == len(options)
        for name, text in described:
            assert not text.startswith("["), (command, name)
        assert set(documented(command)[1]) <= {line.strip() for line in out.splitlines()}
    assert "--gravity [FLOAT]" in helps["respond"][1]
    for command, names in (
        ("run", FORMULATIONS), ("sweep", FORMULATIONS), ("verify", FORMULATIONS),
        ("backbone", VARIANTS),
    ):  # fmt: skip
        assert set(names) <= set(re.findall(r"\w+", helps[command][1]))
