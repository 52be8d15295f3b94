"""Letters that a reader does not see; without NumPy, for the command line starts with it."""

import unicodedata

_STEERING = {"Cc", "Cf", "Cs", "Zl", "Zp"}
"""Categories of letters that steer a terminal, or the direction in which it writes."""

_WITHOUT_WIDTH = frozenset(
    "\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800\u3164\uffa0"
    + "".join(map(chr, (*range(0xFE00, 0xFE10), *range(0xE0100, 0xE01F0))))
)
"""Fillers, joiners and selectors that Unicode counts among letters and marks."""


def is_unseen(letter: str) -> bool:
    """Return whether a letter has no width, or steers a terminal or the direction of writing."""
    return unicodedata.category(letter) in _STEERING or letter in _WITHOUT_WIDTH
