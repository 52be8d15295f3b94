"""`rotbeam schema`: the JSON schema of beam files, by which editors complete and check them."""

from __future__ import annotations

import json
import sys


def schema() -> None:
    """Print the JSON schema of beam files.

    By it, an editor completes and checks a file whose first line is `#:schema beam.schema.json`.

    Examples
    --------
    $ rotbeam schema
    """
    from ..files.beam_tables import schema as of_files

    sys.stdout.write(f"{json.dumps(of_files(), indent=2)}\n")
