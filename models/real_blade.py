r"""
A real blade: NREL's 5 MW
=========================

Its 49 stations have twist, offsets of the centers of mass and a cone: flap, lag and torsion come
together. The first flap at 12.1 rpm, and the motion of the tip when the rotor gets there in 8 s.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from analytic import SpinUp, Theory, campbell, periodic_orbits, spin_up_response
from rotbeam_exu import figures
from rotbeam_exu.files.beam_file import load_beam

plt.style.use(figures.STYLE)
blade, rated = load_beam(Path(figures.__file__).parents[2] / "models/blades/nrel_5mw.toml"), 1.267
rigid = Theory(extension=False)  # along the blade, which stretches by 1 mm
diagram = campbell(blade, np.linspace(0.0, 1.6, 5), count=4, orders=6)
orbits = periodic_orbits(blade, rated, [0.08], gauge="flap", theory=rigid, functions=6)
motion, times = SpinUp(omega=rated, ramp_time=4.0), np.linspace(0.0, 8.0, 161)
start = spin_up_response(blade, motion, times, tolerance=1e-3, theory=rigid)

_, axes = plt.subplots(1, 3, figsize=(10.0, 3.4), layout="constrained")
diagram.plot(axes[0])
orbits.plot(axes[1])
axes[1].set(ylabel="peak of the tip in flap over L")
axes[2].plot(times, start.lag, label="lag")
axes[2].plot(times, start.flap, label="flap")
axes[2].axvline(motion.ramp_time, color="0.7", lw=0.6)
axes[2].set(xlabel="t [s]", ylabel="tip from the clamp's axis [m]")
axes[2].legend()
plt.show()
