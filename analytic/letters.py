"""Texts that users give, and letters that no reader sees; without NumPy, for a quick start."""

import reprlib
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


def plain_text(name: str, value: object, longest: int) -> str:
    """Return a text of at most `longest` letters, all of which a reader sees."""
    if not isinstance(value, str):
        raise TypeError(f"{name} must be text in quotes, got {reprlib.repr(value)}")
    if len(value) > longest:
        raise ValueError(f"{name} has {len(value):,} letters, more than {longest:,}: shorten it")
    for place, letter in enumerate(value):
        if is_unseen(letter):
            near = ascii(value[max(place - 15, 0) : place + 15])
            raise ValueError(
                f"{name} has a letter that no reader sees, {letter!a} in {near}: leave it out"
            )
    return value
