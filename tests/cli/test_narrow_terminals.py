"""Tables in a narrow terminal: titles and texts are folded, and every number is whole."""

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
]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: "-".join(command[:2]))
def test_no_number_is_cut_or_broken(call, monkeypatch, command):
    monkeypatch.setenv("COLUMNS", "1000")
    wide = call(*command)[1]
    monkeypatch.setenv("COLUMNS", "80")
    code, narrow, _ = call(*command)
    assert code == 0

    def words(text):
        for line in "┃│┏┓┗┛┡┩━┳╇└┘─┴":
            text = text.replace(line, " ")
        return set(text.split())

    assert words(wide) == words(narrow)
    assert max(map(len, narrow.splitlines())) <= 80
    monkeypatch.setenv("COLUMNS", "40")
    assert words(call(*command)[1]) == words(wide)


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
    monkeypatch.setenv("COLUMNS", "80")
    code, out, _ = call("verify", "--element", "cable", "--element", "exact")
    assert code == 0
    assert out.count("+1e-04") == 2 * len(THRESHOLDS)
