"""Sentences on standard error: warnings, each kind of them once, and why a command stopped."""

from __future__ import annotations

import re
from collections import Counter
from functools import lru_cache

from rich.text import Text

from .output import harmless, new_console, print_text

_LONGEST = 60
"""Letters of a sentence that are repeated to say which one it was."""


@lru_cache
def _varies() -> re.Pattern[str]:
    """Return what may differ between two warnings of a kind: numbers, and names of models."""
    from analytic import VARIANTS

    names = "|".join(sorted(VARIANTS, key=len, reverse=True))
    return re.compile(rf"(?<!\w)(?:{names})(?!\w)|[+-]?\d+\.?\d*(?:e[+-]?\d+)?")


class Messages:
    """What one command says on standard error.

    Warnings that differ only in their numbers, or in the model they are about, are one: the first
    is printed at once, and how many followed at the end.
    """

    def __init__(self) -> None:
        self._console = new_console(stderr=True)
        self._said: dict[str, str] = {}
        self._more: Counter[str] = Counter()
        self._texts: set[str] = set()

    def say(self, title: str, style: str, text: str) -> None:
        """Print a sentence in one line after its title."""
        print_text(
            self._console, Text.assemble((title, style), " ", harmless(" ".join(text.split())))
        )

    def warn(self, message: Warning | str, *_: object) -> None:
        """Print a warning, or count it: what `warnings.showwarning` takes."""
        text = " ".join(str(message).split())
        if text in self._texts:  # several of our functions may notice the same
            return
        self._texts.add(text)
        kind = _varies().sub("#", text)
        if kind in self._said:
            self._more[kind] += 1
            return
        self._said[kind] = text
        self.say("warning:", "yellow", text)

    def count(self) -> None:
        """Say how many warnings were not printed."""
        for kind, more in self._more.items():
            first = self._said[kind]
            begin = first if len(first) <= _LONGEST else f"{first[:_LONGEST].rsplit(' ', 1)[0]} ..."
            self.say("warning:", "yellow", f"{more} more like it, with other numbers: {begin}")
        self._more.clear()
