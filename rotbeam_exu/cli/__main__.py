"""`python -m rotbeam_exu.cli`, the same as `rotbeam`."""

from . import main

main()
