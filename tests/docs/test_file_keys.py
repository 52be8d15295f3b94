"""The table of a file's keys is complete: it has those of the schema, and no others."""

import json
import re
import subprocess
import sys

from docs.sentences import ROOT

PAGE = ROOT / "docs" / "howto" / "own_beam.md"


def keys_of(node, path=""):
    """Yield (table, key) of a JSON schema; kinds of one table together."""
    for part in [*node.get("anyOf", []), *([node["items"]] if "items" in node else [])]:
        yield from keys_of(part, path) if isinstance(part, dict) else ()
    for key, below in node.get("properties", {}).items():
        yield path, key
        yield from keys_of(below, f"{path}.{key}" if path else key)


def test_the_table_of_keys_is_that_of_the_schema():
    # In a process of its own: other tests add kinds.
    command = [sys.executable, "-m", "rotbeam_exu.cli", "schema"]
    schema = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    text = PAGE.read_text(encoding="utf-8").partition("## All keys of a file")[2]
    table, listed = None, {}
    for first, keys in re.findall(r"^\| (.*?) ?\| (.*?) \|", text, re.MULTILINE)[2:]:
        table = re.sub(r"[`\[\]]", "", first) or table
        listed.setdefault(table, set()).update(re.findall(r"`(\w+)`", keys))
    known = {}
    for path, key in keys_of(schema):
        known.setdefault(path.replace("stations.shapes", "section.shape"), set()).add(key)
    shapes = {"beam.shape", "blade.section.shape"}
    of_shapes = {key for name in shapes for key in known.pop(name)}
    assert of_shapes == listed.pop("blade.section.shape")
    assert {*known.pop("")} == {name.partition(".")[0] for name in listed}
    assert listed.pop("uncertainty") == {"length"}
    loads = listed.pop("loads")
    assert loads == {"kind"}
    known.pop("loads")
    assert listed == known
