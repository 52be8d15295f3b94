"""Tables in a narrow terminal: fewer columns side by side, and every number whole."""

import pytest

from rotbeam_exu.verification import verify as room
from rotbeam_exu.verification.convergence import converged
from rotbeam_exu.verification.judgement import THRESHOLDS, Judgement
from rotbeam_exu.verification.outcomes import found_of
from rotbeam_exu.verification.submission import Declaration

COMMANDS = [
    ("backbone", "--omega", "6", "--all-variants", "--amplitude", "0.05", "0.2"),
    ("campbell", "--points", "3", "--count", "3", "--orders", "2", "--omega-max", "6"),
    ("table", "2"),
    ("table", "3"),
]


@pytest.mark.parametrize("columns", [20, 80])
@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: "-".join(command[:2]))
def test_no_number_is_cut_or_broken(call, monkeypatch, command, columns):
    monkeypatch.setenv("COLUMNS", "1000")
    wide = call(*command)[1]
    monkeypatch.setenv("COLUMNS", str(columns))
    code, narrow, _ = call(*command)
    assert code == 0
    assert "…" not in narrow

    def words(text):
        for line in "┃│┏┓┗┛┡┩━┳╇└┘─┴":
            text = text.replace(line, " ")
        return set(text.split())

    assert words(wide) == words(narrow)
    # In narrower terminals a line may be longer, and no number is lost.
    if columns == 80:
        assert max(map(len, narrow.splitlines())) <= columns


def test_the_verdict_tables(call, monkeypatch):
    runs = converged((40, 80, 160), None, [1.23e-4 + n**-4.0 for n in (40, 80, 160)])
    found = found_of(runs, tolerance=2e-4, bound=1e-8, where="anywhere")
    monkeypatch.setattr(
        room,
        "verify",
        lambda entry, **_: Judgement(
            declaration=Declaration(code=entry.name),
            findings={"S1": dict.fromkeys(THRESHOLDS, found)},
            histories={}, sources={}, remarks={}, asked=("S1",),
        ),
    )  # fmt: skip
    monkeypatch.setenv("COLUMNS", "40")
    code, out, _ = call("verify", "--element", "cable", "--element", "exact")
    assert code == 0
    assert out.count("+1e-04") == 2 * len(THRESHOLDS)
    assert "…" not in out
