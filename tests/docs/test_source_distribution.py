"""What a source distribution holds: enough to do what its README says."""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from fnmatch import fnmatch
from pathlib import Path

import pytest

import rotbeam_exu

ROOT = Path(__file__).parents[2]
LICENSES = ROOT / "LICENSES"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("source", ["Makefile", ".ci/run", "CONTRIBUTING.md", "README.md"])
def test_it_holds_every_file_that_is_named(source):
    included = PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
    words = set(re.findall(r"[\w.][\w./-]*\w", (ROOT / source).read_text(encoding="utf-8")))
    named = {word for word in words if (ROOT / word).is_file()} | {source}
    always = {"pyproject.toml", ".gitignore"}  # hatchling's own rule
    missing = {
        name
        for name in named - always
        if not any(fnmatch(name, one) or name.startswith(f"{one}/") for one in included)
    }
    assert missing == set()


@pytest.mark.slow
def test_it_builds_and_runs_where_it_is_unpacked(tmp_path):
    """The main job, by the Makefile in it, which makes an environment of its own.

    It and the wheel have the texts of all licenses.
    """
    env = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}

    def run(*words, cwd=tmp_path):
        done = subprocess.run(
            list(map(str, words)), cwd=cwd, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr

    run(sys.executable, "-m", "venv", "builder")
    python = tmp_path / "builder" / "bin" / "python"
    run(python, "-m", "pip", "install", "-q", *PROJECT["build-system"]["requires"])
    run(python, "-m", "hatchling", "build", "-d", tmp_path, cwd=ROOT)
    (packed,), (wheel,) = tmp_path.glob("*.tar.gz"), tmp_path.glob("*.whl")
    with tarfile.open(packed) as file:
        file.extractall(tmp_path, filter="data")
    unpacked = tmp_path / packed.name.removesuffix(".tar.gz")
    texts = {"LICENSE", "NOTICE", *(f"LICENSES/{path.name}" for path in LICENSES.glob("*"))}
    assert all((unpacked / name).is_file() for name in {*texts, "REUSE.toml"})
    inside = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/licenses/")[2] for name in inside if "/licenses/" in name} == texts
    assert "rotbeam_exu/verification/data/references.nc.license" in inside
    run("make", "run", f"PYTHON={sys.executable}", cwd=unpacked)
    written = {path.suffix for path in (unpacked / "results").rglob("*")}
    assert {".nc", ".csv", ".png"} <= written


def test_a_release_asks_that_tag_and_version_agree():
    workflow = (ROOT / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8")
    (asked,) = re.findall(r"^ *run: (test .*)$", workflow, re.MULTILINE)
    for tag, right in ((f"v{rotbeam_exu.__version__}", True), ("v9.9.9", False), ("", False)):
        env = {**os.environ, "GITHUB_REF_NAME": tag}
        done = subprocess.run(["sh", "-c", asked], cwd=ROOT, env=env, check=False)
        assert (done.returncode == 0) == right, tag


def test_the_readme_of_an_index_has_no_link_that_leads_nowhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for one in PROJECT["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"]["substitutions"]:
        text = re.sub(one["pattern"], one["replacement"], text)
    targets = re.findall(r"\]\(([^)]*)\)", text)
    assert targets
    assert all(target.startswith("https://") for target in targets)
