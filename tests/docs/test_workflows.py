"""Workflows: actions by commit, and a right to publish where nothing of others is run."""

import re
from itertools import pairwise
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / ".github" / "workflows").glob("*.y*ml"))
PUBLISHED = {
    "release.yml": ["actions/download-artifact", "pypa/gh-action-pypi-publish"],
    "site.yml": ["actions/deploy-pages"],
}
HASHED = ROOT / ".ci" / "build-requirements.txt"


def jobs_of(text):
    """Return the text of each job by its name: what is indented by two below `jobs:`."""
    _, _, jobs = text.partition("\njobs:\n")
    heads = [*re.finditer(r"^  ([\w-]+):\n", jobs, re.MULTILINE)]
    ends = [head.start() for head in heads[1:]] + [len(jobs)]
    return {head[1]: jobs[head.end() : end] for head, end in zip(heads, ends, strict=True)}


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_the_host_can_read_it(file):
    text = file.read_text(encoding="utf-8")
    assert list(yaml.safe_load(text)["jobs"]) == list(jobs_of(text))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_actions_are_commits(file):
    used = re.findall(r"\buses: *(\S+)(.*)", file.read_text(encoding="utf-8"))
    assert used
    for action, rest in used:
        assert re.fullmatch(r"[\w-]+/[\w./-]+@[0-9a-f]{40}", action), action
        assert re.fullmatch(r" # v\d+\.\d+\.\d+", rest), f"{action}: its version in a comment"


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_the_right_to_publish_runs_no_code(file):
    """Not in the file as a whole either; only the artifact's and the index's own actions."""
    text = file.read_text(encoding="utf-8")
    whole, _, _ = text.partition("\njobs:\n")
    assert re.search(r"^permissions: \{ contents: read \}$", whole, re.MULTILINE)
    for name, job in jobs_of(text).items():
        rights = re.findall(r"[\w-]+: *write", job)
        if name == "attach":
            assert rights == ["contents: write"]
            (command,) = re.findall(r"\brun: (.*)", job)
            assert command.startswith('gh release create "$GITHUB_REF_NAME" explorer.html ')
            assert re.findall(r"\buses: *([\w./-]+)@", job) == ["actions/download-artifact"]
        elif rights:
            pages = ["pages: write"] if file.name == "site.yml" else []
            assert (name, rights) == ("publish", [*pages, "id-token: write"])
            assert re.findall(r"\buses: *([\w./-]+)@", job) == PUBLISHED[file.name]
            assert not re.search(r"\brun:", job)


def test_a_release_is_built_from_files_whose_hashes_are_known():
    jobs = jobs_of((ROOT / ".github/workflows/release.yml").read_text(encoding="utf-8"))
    assert list(jobs) == ["test", "build", "publish", "explorer", "attach"]
    for before, after in pairwise(list(jobs)[:3]):
        assert f"needs: {before}\n" in jobs[after]
    ran = re.findall(r"\brun: \"?([^\"\n]*)", jobs["build"])
    (install, build) = ran
    assert install.split()[-2:] == ["-r", HASHED.relative_to(ROOT).as_posix()]
    assert "--require-hashes" in install
    assert "--only-binary :all:" in install  # a source distribution runs code as it is installed
    assert "--no-isolation" in build  # or the backend would be fetched anew, without hashes
    packages = re.split(r"^(?=[\w-]+==)", HASHED.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert {one.partition("==")[0] for one in packages[1:]} >= {
        "build", "hatchling", "hatch-fancy-pypi-readme"
    }  # fmt: skip
    assert all(re.search(r"--hash=sha256:[0-9a-f]{64}", one) for one in packages[1:])
