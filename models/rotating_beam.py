"""The main job: spin the paper's beam up in Exudyn and look at its steady oscillation.

Run it as `python models/rotating_beam.py --omega 6 --ramp-time 3`; `--help` lists the options.
The installed command `rotbeam run` is the same.
"""

import sys

from rotbeam_exu.cli import main

if __name__ == "__main__":
    main(["run", *sys.argv[1:]])
