"""run.toml: a command that makes the histories, so that a submission may run by itself.

    command = "matlab -batch run({case},{elements},{step})"
    cases = ["S1"]
    meshes = [8, 16, 32]
    steps = [1e-3, 2e-3, 5e-4]

Each mesh is run at the first step, each step on the first mesh. The command is run in the
submission's folder, without a shell, and writes {file}.
"""

from __future__ import annotations

import csv
import os
import re
import shlex
import subprocess
import time as clock
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from analytic.input_checks import positive, whole_number

from ..cases import CASES, Asked, Case
from . import runs
from .content import LARGEST_TOML, content_of, text_of
from .faults import Faults, MalformedSubmissionError
from .tables import shown

FILE = "run.toml"
_REQUIRED = ("command", "cases", "meshes", "steps")
_PLACES = ("case", "elements", "step", "file")
_LONGEST = 86400.0
"""Time that a run may take unless run.toml says another [s]."""

_SAID = 300
"""Letters of what a failed command said that go on record."""


@dataclass(frozen=True, kw_only=True)
class Command:
    """What run.toml says.

    Attributes
    ----------
    words : tuple of str
        Of the command, with {case}, {elements}, {step} and {file} in them.
    cases : tuple of str
    meshes : tuple of int
    steps : tuple of float
        [s].
    timeout : float
        [s].
    """

    words: tuple[str, ...]
    cases: tuple[str, ...]
    meshes: tuple[int, ...]
    steps: tuple[float, ...]
    timeout: float

    def asked(self) -> Iterator[tuple[str, int, float]]:
        """Yield case, mesh and step of each run."""
        places = [(elements, self.steps[0]) for elements in self.meshes]
        places += [(self.meshes[0], step) for step in self.steps[1:]]
        for case in self.cases:
            for elements, step in places:
                yield case, elements, step

    def filled(self, case: str, elements: int, step: float) -> list[str]:
        """Return the words for one run."""
        file = runs.file_of(case, elements, step)
        values = {"case": case, "elements": str(elements), "step": repr(step), "file": file}
        return [
            re.sub(r"\{(\w+)\}", lambda match: values.get(match[1], match[0]), word)
            for word in self.words
        ]


def command_of(folder: Path, *, cases: Mapping[str, Case] = CASES) -> Command:
    """Return what run.toml says; MalformedSubmissionError with all that is wrong with it."""
    faults = Faults()
    text = text_of(folder, FILE, faults, LARGEST_TOML)
    document: dict[str, Any] = {}
    try:
        document = tomllib.loads(text or "")
    except (RecursionError, ValueError) as error:
        faults.add(FILE, f"is not valid TOML: {error}")
    if not faults:
        histories = tuple(name for name, case in cases.items() if case.asked is Asked.HISTORY)
        for said in _wrong_with(document, histories):
            faults.add(FILE, said)
    if faults:
        raise MalformedSubmissionError(faults.told())
    return Command(
        words=tuple(shlex.split(document["command"])),
        cases=tuple(document["cases"]),
        meshes=tuple(document["meshes"]),
        steps=tuple(map(float, document["steps"])),
        timeout=float(document.get("timeout", _LONGEST)),
    )


def run_what_is_missing(folder: str | os.PathLike[str]) -> Iterator[str]:
    """Run the command of run.toml for each run without a row in runs.csv; yield what is done.

    A run that fails gets its row too, with what the command said last: it stays on record, and is
    run again once its row is taken out.
    """
    root = Path(folder)
    if not root.is_dir():
        raise FileNotFoundError(f"there is no folder {root}: name that of the submission")
    command = command_of(root)
    listed = _listed(root)
    for case, elements, step in command.asked():
        file = runs.file_of(case, elements, step)
        if file in listed:
            continue
        yield f"{file}: running"
        wall, cpu, failure = _run(root, command, case, elements, step)
        if failure or file not in _listed(root):
            row = [file, elements, repr(step), "", f"{wall:.6g}", f"{cpu:.6g}", failure, ""]
            _append(root, row)
        yield f"{file}: {'failed, ' + failure if failure else f'{wall:.3g} s'}"


def _listed(root: Path) -> set[str]:
    """Return the files that runs.csv has a row for; it may be wrong otherwise."""
    if not os.path.lexists(root / runs.FILE):
        return set()
    faults = Faults()
    found = {one.file for one in runs.listed_runs(root, CASES, faults)}
    if faults:
        raise MalformedSubmissionError(faults.told())
    return found


def _run(
    root: Path, command: Command, case: str, elements: int, step: float
) -> tuple[float, float, str]:
    """Run the command once; return wall and processor time [s], and why it failed."""
    file = root / runs.file_of(case, elements, step)
    file.parent.mkdir(exist_ok=True)
    words = command.filled(case, elements, step)
    wall, before = clock.perf_counter(), os.times()
    failure = ""
    try:
        done = subprocess.run(
            words, cwd=root, capture_output=True, timeout=command.timeout, check=False,
            stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        failure = f"took longer than {command.timeout:g} s"
    except (OSError, ValueError) as error:
        raise ValueError(f"{FILE}: {shown(words[0])} cannot be run: {error}") from error
    else:
        said = (done.stderr or done.stdout).decode("utf-8", "replace").strip().splitlines()
        last = " ".join(said[-1].split())[-_SAID:] if said else "it said nothing"
        if done.returncode:
            failure = f"exit code {done.returncode}: {last}"
        elif not file.is_file():
            failure = f"wrote no {file.name}: {last}"
    after = os.times()
    cpu = after.children_user + after.children_system
    cpu -= before.children_user + before.children_system
    return clock.perf_counter() - wall, cpu, failure


def _append(root: Path, row: list[Any]) -> None:
    """Add a row to runs.csv in the order of its own header, which a new one gets."""
    path, columns = root / runs.FILE, (*runs.REQUIRED, *runs.OPTIONAL)
    if not os.path.lexists(path):
        path.write_text(",".join(columns) + "\n", encoding="utf-8", newline="\n")
    text = content_of(root, runs.FILE).decode("utf-8-sig")
    names = next(line for line in text.splitlines() if line.strip() and line[0] != "#").split(",")
    names = [name.strip(' "') for name in names]
    cells = dict(zip(columns, row, strict=True))
    if cells["failure"] and "failure" not in names:
        raise ValueError(
            f"{path.name} has no column failure for what went wrong, {cells['failure']}: add it"
        )
    with path.open("a", encoding="utf-8", newline="") as file:
        if not text.endswith("\n"):
            file.write("\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([cells.get(name, "") for name in names])


def _wrong_with(document: Mapping[str, Any], histories: tuple[str, ...]) -> Iterator[str]:
    """Yield what is wrong with run.toml."""
    for key in document:
        if key not in (*_REQUIRED, "timeout"):
            yield f"unknown key {shown(key)}; known are {', '.join((*_REQUIRED, 'timeout'))}"
    for key in _REQUIRED:
        if key not in document:
            yield f"there is no {key}"
    yield from _wrong_command(document.get("command", "a"))
    for key, check in (("cases", _case_of(histories)), ("meshes", _mesh), ("steps", _step)):
        values = document.get(key, ["S1"] if key == "cases" else [1])
        if not isinstance(values, list) or not values:
            yield f"{key} must be a list"
            continue
        for value in values:
            try:
                check(value)
            except (TypeError, ValueError) as error:
                yield str(error)
    try:
        positive("timeout", document.get("timeout", 1.0), "s")
    except (TypeError, ValueError) as error:
        yield str(error)


def _wrong_command(text: object) -> Iterator[str]:
    if not isinstance(text, str) or not text.strip():
        yield "command must be text"
        return
    try:
        shlex.split(text)
    except ValueError as error:
        yield f"command {shown(text)} cannot be split into words: {error}"
    for name in re.findall(r"\{(\w*)\}", text):
        if name not in _PLACES:
            yield f"command has {{{name}}}; known are {', '.join(f'{{{one}}}' for one in _PLACES)}"


def _case_of(histories: tuple[str, ...]) -> Any:
    def check(value: object) -> None:
        if value not in histories:
            known = ", ".join(histories)
            raise ValueError(f"{shown(str(value))} is no case with a history; known are {known}")

    return check


def _mesh(value: object) -> None:
    whole_number("meshes", value)


def _step(value: object) -> None:
    positive("steps", value, "s")
