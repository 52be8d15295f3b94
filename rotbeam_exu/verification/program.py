"""A program of an author, called once for each case, mesh and step, within limits.

The command is the author's own, on the author's machine; nothing of it is ever taken from a
submission.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import time as clock
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from analytic.input_checks import positive

from .case import Asked, Case
from .submission import LONGEST_NAME
from .submission_files import runs
from .submission_files.faults import near, printable

_WORD = re.compile(r"\{(\w+)\}")
_WORDS = "case", "elements", "step", "tolerance", "out"

STOPPED = "was stopped after"
"""Beginning of the failure of a run that took too long."""


@dataclass(frozen=True, kw_only=True)
class Program:
    """A program that is called once for each case, mesh and step.

    Parameters
    ----------
    command : str
        With {case} and {elements}, and {step} [s] or {tolerance} in their places. {out} is the file
        to write; without it the program writes the kit's names into the folder in which it runs.
    seconds : float
        Time on the clock after which a run is stopped.
    memory : float, optional
        Address space of a run [GiB]; not limited unless given, and never on Windows.

    Raises
    ------
    ValueError
        If a word in braces is missing or unknown, or there is no such program.
    """

    command: str
    seconds: float = 600.0
    memory: float | None = None

    def __post_init__(self) -> None:
        """Check the words in braces, the program and the limits."""
        words = _WORD.findall(self.command)
        if unknown := [word for word in words if word not in _WORDS]:
            names = [f"{{{word}}}" for word in _WORDS]
            raise ValueError(
                f"command has {{{unknown[0]}}}; {near(f'{{{unknown[0]}}}', names, str)}"
            )
        if not {"case", "elements"} <= set(words) or ("step" in words) is ("tolerance" in words):
            raise ValueError(
                "command must have {case} and {elements}, and {step} or {tolerance}, as "
                f'"./mycode {{case}} {{elements}} {{step}} {{out}}"; got {self.command!r}'
            )
        program = shlex.split(self.command)[0]
        if shutil.which(program) is None:
            raise ValueError(f"there is no program {program!r} that can be run")
        positive("seconds", self.seconds)
        if self.memory is not None:
            positive("memory", self.memory)

    @property
    def is_adaptive(self) -> bool:
        """Whether it chooses its steps by a tolerance."""
        return "{tolerance}" in self.command

    def run(self, case: Case, elements: int, size: float, out: Path) -> tuple[str, float, float]:
        """Run it, and return why it failed, nothing if it did not, and its wall and CPU time [s].

        `size` is the step or the tolerance, `out` the file that it is to write.
        """
        of = {"case": case.name, "elements": str(elements), "out": str(out.resolve())}
        of |= dict.fromkeys(("step", "tolerance"), runs.size_in_words(size))
        here, words = None, shlex.split(self.command)
        if "{out}" not in self.command:  # in the folder of a submission of its own
            here = out.parent if case.asked is not Asked.HISTORY else out.parent.parent
            words = [str(Path(word).resolve()) if Path(word).is_file() else word for word in words]
        words = [_WORD.sub(lambda word: of[word[1]], one) for one in words]
        if self.memory is not None and os.name == "posix":
            most = str(round(self.memory * 2**20))
            words = ["/bin/sh", "-c", 'ulimit -v "$0"; exec "$@"', most, *words]
        times, started = os.times(), clock.perf_counter()
        failure = self._failure(words, here)
        wall, after = clock.perf_counter() - started, os.times()
        cpu = sum(after[2:4]) - sum(times[2:4])  # of the children
        if not failure and not out.is_file():
            failure = f"ended well, and wrote no file {out.name}"
        return failure, wall, cpu

    def _failure(self, words: Sequence[str], here: Path | None) -> str:
        with (
            tempfile.TemporaryFile() as said,
            subprocess.Popen(
                words, cwd=here, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT,
                start_new_session=True,
            ) as process,
        ):  # fmt: skip
            try:
                code = process.wait(self.seconds)
            except BaseException as error:
                _kill(process)
                if isinstance(error, subprocess.TimeoutExpired):
                    return f"{STOPPED} {self.seconds:g} s"
                raise
            if not code:
                return ""
            size = said.seek(0, os.SEEK_END)
            said.seek(max(size - 4096, 0))
            lines = said.read().decode(errors="replace").split("\n")
        last = printable(next((one.strip() for one in reversed(lines) if one.strip()), ""))
        ended = f"exit code {code}" if code > 0 else f"killed by {signal.Signals(-code).name}"
        return f"{ended}: {last[:LONGEST_NAME]}" if last else ended


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill a process, and those that it has started."""
    if os.name == "posix":
        with suppress(ProcessLookupError):  # all have ended meanwhile
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
