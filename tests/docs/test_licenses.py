"""The license of every file is stated, and its text is at hand."""

import hashlib
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
ANNOTATIONS = tomllib.loads((ROOT / "REUSE.toml").read_text(encoding="utf-8"))["annotations"]
LICENSES = ROOT / "LICENSES"


def matches(pattern, name):
    """Return whether a name is one of REUSE.toml's pattern: only ** crosses folders."""
    parts = re.split(r"(\*\*|\*)", pattern)
    wild = {"**": ".*", "*": "[^/]*"}
    return re.fullmatch("".join(wild.get(part, re.escape(part)) for part in parts), name)


def license_of(name):
    """Return the license of the last annotation that matches."""
    for annotation in reversed(ANNOTATIONS):
        patterns = annotation["path"]
        for pattern in [patterns] if isinstance(patterns, str) else patterns:
            if matches(pattern, name):
                return annotation["SPDX-License-Identifier"]
    return None


def files(*folders):
    return sorted(
        path.relative_to(ROOT).as_posix()
        for folder in folders
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    )


def test_all_data_are_under_a_license_for_data():
    kinds = {".csv", ".json", ".nc", ".pdf", ".toml"}
    everything = files("models", "rotbeam_exu/verification/data")
    found = [name for name in everything if Path(name).suffix in kinds]
    assert len(found) > 100
    by_license = {name: license_of(name) for name in found}
    assert set(by_license.values()) == {"CC-BY-4.0", "Apache-2.0"}
    assert {name for name, one in by_license.items() if one == "Apache-2.0"} == set(
        files("models/blades")
    )


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("analytic/blade.py", "MIT"),
        ("models/codes/rod/run.py", "MIT"),
        ("models/codes/rod/submission/S1/m008_h2e-3.csv", "CC-BY-4.0"),
        ("rotbeam_exu/verification/data/kit/starters/python/starter.py", "MIT"),
    ],
)
def test_the_last_annotation_holds(name, known):
    assert license_of(name) == known


def test_licenses_that_are_named_have_their_text():
    named = {annotation["SPDX-License-Identifier"] for annotation in ANNOTATIONS}
    assert {path.stem for path in LICENSES.glob("*.txt")} == named
    assert set(PROJECT["license"].split(" AND ")) == named
    shipped = {path.name for one in PROJECT["license-files"] for path in ROOT.glob(one)}
    assert shipped == {"LICENSE", "NOTICE", *(f"{one}.txt" for one in named)}
    assert (LICENSES / "MIT.txt").read_text() == (ROOT / "LICENSE").read_text()


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("Apache-2.0", "cfc7749b96f63bd31c3c42b5c471bf756814053e847c10f3eb003417bc523d30"),
        ("CC-BY-4.0", "4014722237c90b6f8effc35b6e04a47815c03ef14ee24683d6c1dfd0b9b644d0"),
    ],
)
def test_texts_are_those_of_their_publishers(name, digest):
    assert hashlib.sha256((LICENSES / f"{name}.txt").read_bytes()).hexdigest() == digest


def test_the_notice_names_every_blade():
    notice = (ROOT / "NOTICE").read_text(encoding="utf-8")
    assert set(re.findall(r"^(models/blades/\S+\.toml)$", notice, re.MULTILINE)) == set(
        files("models/blades")
    )


def test_data_that_travel_alone_state_their_license():
    data = ROOT / "rotbeam_exu" / "verification" / "data"
    for path in (data / "references.nc.license", data / "kit" / "README.md"):
        assert "https://creativecommons.org/licenses/by/4.0/" in path.read_text(encoding="utf-8")
    page = (ROOT / "docs" / "licenses.md").read_text(encoding="utf-8")
    # British readers find the page too.
    assert "```{index} licence" in page
