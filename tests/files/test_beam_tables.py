"""The JSON schema of beam files and the loader: they take and refuse the same."""

import json
import re
import tomllib
from pathlib import Path

import pytest

from rotbeam_exu.files.beam_file import load_run_file
from rotbeam_exu.files.beam_tables import schema
from tests.beams import BLADE_TOML
from tests.files.test_beam_file import DAMPED, GOOD, LINE, PLANE, STATIONS, WHOLE
from tests.files.test_stations_file import SHAPES

ROOT = Path(__file__).parents[2]
TYPES = {"number": (int, float), "integer": int, "string": str, "array": list, "object": dict}
FILES = sorted((ROOT / "models" / "blades").glob("*.toml"))
PAGES = sorted(p for p in (ROOT / "docs").rglob("*.md") if "_build" not in p.parts)
BLOCKS = [
    text
    for page in [*PAGES, ROOT / "README.md"]
    for text in re.findall(r"```toml\n(.*?)```", page.read_text("utf-8"), re.DOTALL)
    if re.search(r"^\[+(beam|blade|motion|loads)\b", text, re.MULTILINE)
]
KINKED = LINE.replace("precone = 0.04", "kinks = [[4.0, 0.0, 0.1]]")
SHAPED = GOOD + 'shape = { kind = "Rectangle" }\n'
RUN = '[motion]\nomega = 4\n[numerics]\nelement = "cable"\nelements = 2\n'
LOADS = f'{RUN}[[loads]]\nkind = "TipForce"\namplitude = 0.5\nfrequency = 3\n'
TEXTS = [*(p.read_text("utf-8") for p in FILES), *BLOCKS, GOOD, WHOLE, DAMPED, SHAPED, KINKED,
         WHOLE.replace("mass_per_length = [0.2, -0.02]", PLANE + "bending_ratio = 1.0"),
         STATIONS, SHAPES, f"{BLADE_TOML}[blade.damping]\nratio = 0.02\n", RUN, LOADS]  # fmt: skip


def fits(value, told):  # noqa: PLR0911
    """Whether a value is as a schema says: as much of JSON schema as ours has."""
    if "anyOf" in told:
        return any(fits(value, one) for one in told["anyOf"])
    if "enum" in told:
        return value in told["enum"]
    kinds = [told["type"]] if isinstance(told["type"], str) else told["type"]
    if "boolean" in kinds or isinstance(value, bool):
        return "boolean" in kinds and isinstance(value, bool)
    if not any(isinstance(value, TYPES[kind]) for kind in kinds):
        return False
    if isinstance(value, dict):
        if not all(name in value for name in told["required"]):
            return False
        known = told["properties"]
        return all(name in known and fits(part, known[name]) for name, part in value.items())
    return not ("items" in told and not all(fits(part, told["items"]) for part in value))


def both(text, path):
    """Whether schema and loader take a file."""
    path.write_text(text, encoding="utf-8")
    path.with_name("loads.csv").write_text("x [m],fz [N/m]\n4,1\n8,2\n", encoding="utf-8")
    try:
        load_run_file(path)
    except ValueError:
        return fits(tomllib.loads(text), schema()), False
    return fits(tomllib.loads(text), schema()), True


@pytest.mark.parametrize("text", TEXTS)
def test_every_file_there_is_fits_both_and_a_wrong_key_in_any_table_none(tmp_path, text):
    """The key is put behind each header, and in front of all of them."""
    path = tmp_path / "beam.toml"
    assert both(text, path) == (True, True)
    headers = [match.end() for match in re.finditer(r"^\[.*\]\n", text, re.MULTILINE)]
    for place in (0, *headers):
        assert both(f"{text[:place]}lenght = 1.0\n{text[place:]}", path) == (False, False)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("length = 8.0", "length = '8.0'"), ("length = 8.0", ""),
        ("position = 4.0", ""), ("mass_per_length = [0.2, -0.02]", "mass_per_length = 'x'"),
        ("[blade.damping]", "[[blade.damping]]"), ("[[blade.point_mass]]", "[blade.point_mass]"),
    ],
)  # fmt: skip
def test_a_missing_key_and_a_wrong_type_are_refused_by_both(tmp_path, old, new):
    assert both(WHOLE.replace(old, new, 1), tmp_path / "blade.toml") == (False, False)


def test_the_command_prints_the_schema(call):
    assert json.loads(call("schema")[1]) == schema()
