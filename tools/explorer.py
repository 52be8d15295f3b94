"""Compute the Explorer's data of the paper's beam, for the package: part of `make references`."""

import lzma
from pathlib import Path

import rotbeam_exu.explorer
from rotbeam_exu.explorer import SHIPPED, explorer_data, packed

if __name__ == "__main__":
    place = Path(rotbeam_exu.explorer.__file__).with_name(SHIPPED)
    place.write_bytes(lzma.compress(packed(explorer_data()).encode(), preset=9))
