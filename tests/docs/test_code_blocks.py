"""Every block of code in the README and the pages runs; commands exist."""

import os
import re
import shlex
from pathlib import Path

import pytest

from docs._ext import blocks
from rotbeam_exu.cli import app

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
PAGES = [p for p in PAGES if "_build" not in p.parts and "gallery" not in p.parts]
# Pages that run finite elements in number, long spin-ups, fits, limits of stability, a cluster,
# the blade of test_real_blade, or the branch of test_leaving.
SLOW = ("howto/sensitivity", "theory/harmonic_balance", "theory/planar", "theory/errata",
        "theory/spin_up", "howto/forced_response", "howto/own_beam", "howto/own_element",
        "howto/real_blade", "howto/files")  # fmt: skip
SLOW_PAGES = {ROOT / "docs" / f"{name}.md" for name in SLOW}


def page_cases(language, slow=()):
    for page in PAGES:
        found = list(blocks.fenced(page.read_text(encoding="utf-8")))
        if any(block.language == language for block in found):
            marks = [pytest.mark.slow] if page in slow else []
            yield pytest.param(page, id=str(page.relative_to(ROOT)), marks=marks)


def slurm(folder):
    """A folder with the two commands of SLURM that Dask uses; jobs run on this machine."""
    folder.mkdir()
    for name, text in {
        "sbatch": 'bash "$1" > job.log 2>&1 & echo "Submitted batch job $!"',
        "scancel": 'pkill -P "$1"; kill "$1"',
    }.items():
        (folder / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        (folder / name).chmod(0o755)
    return folder


@pytest.fixture
def printed_by(tmp_path, monkeypatch):
    """Return what each block of a page prints, in names of its own and a temporary folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.setenv("PATH", str(slurm(tmp_path / "bin")), prepend=os.pathsep)

    def run(page, language):
        names = blocks.names(tmp_path)
        for block in blocks.fenced(page.read_text(encoding="utf-8")):
            if block.language == language:
                where = f"{page.name}:{block.line}"
                yield where, blocks.printed(block.text, names, where)

    return run


@pytest.mark.parametrize("page", list(page_cases("python", SLOW_PAGES)))
def test_blocks_that_are_shown_run_in_order(page, printed_by):
    assert list(printed_by(page, "python"))


@pytest.mark.slow  # the site's build runs the same blocks
@pytest.mark.parametrize("page", list(page_cases("{computed}")))
def test_blocks_that_compute_print_something(page, printed_by):
    for where, output in printed_by(page, "{computed}"):
        assert output.strip(), f"{where} prints nothing"


def commands():
    for page in PAGES:
        for block in blocks.fenced(page.read_text(encoding="utf-8")):
            if block.language == "bash":
                for line in block.text.splitlines():
                    yield pytest.param(line, id=f"{page.name}: {line[:40]}")
        # Indented blocks, as the README has them.
        for line in re.findall(
            r"^    (make .*|rotbeam .*)$", page.read_text("utf-8"), re.MULTILINE
        ):
            yield pytest.param(line, id=f"{page.name}: {line[:40]}")


@pytest.mark.parametrize("line", list(commands()))
def test_commands_shown_exist(line):
    words = shlex.split(line.replace("$SLURM_ARRAY_TASK_ID", "1"), comments=True)
    if words[:1] == ["rotbeam"]:
        assert words[1] in set(app)
        command, bound, *_ = app.parse_args(words[1:], exit_on_error=False, print_error=False)
        assert command.__name__.replace("_", "-") == words[1]
        assert bound is not None
    elif words[:1] == ["make"]:
        targets = (ROOT / "Makefile").read_text(encoding="utf-8")
        assert re.search(rf"^{re.escape(words[1])}:", targets, re.MULTILINE)
    else:
        known = ([], ["pip", "install"], ["git", "clone"], ["export", "OMP_NUM_THREADS=1"])
        assert words[:2] in known
