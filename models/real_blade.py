r"""
A real blade: NREL's 5 MW
=========================

Its 49 stations have twist, offsets of the centers of mass and a cone, so that flap, lag and torsion
come together. The first and third mode are mostly flap, the second lag, which hardly stiffens.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from analytic import SpinUp, Theory, campbell, periodic_orbits, spin_up_response
from rotbeam_exu import figures
from rotbeam_exu.files.beam_file import load_beam

plt.style.use(figures.STYLE)
blade = load_beam(Path(figures.__file__).parents[2] / "models" / "blades" / "nrel_5mw.toml")
rated, theory = 1.267, Theory(extension=False)  # 12.1 rpm
diagram = campbell(blade, np.linspace(0.0, 1.6, 5), count=3, orders=3)
orbits = periodic_orbits(blade, rated, [0.05], mode="flap 1", theory=theory, functions=6)
motion, times = SpinUp(omega=rated, ramp_time=4.0), np.linspace(0.0, 6.0, 121)
start = spin_up_response(blade, motion, times, theory=theory, tolerance=1e-6)

_, (left, middle, right) = plt.subplots(1, 3, figsize=(7.2, 2.6), layout="constrained")
diagram.plot(left)
orbits.plot(middle)
middle.set(ylabel="peak of the tip in flap, over L")
middle.locator_params(axis="x", nbins=3)
middle.ticklabel_format(useOffset=False)
for part, look, name in ((1, "-", "lag"), (2, "--", "flap")):
    right.plot(times, start.tip[:, part], look, label=name)
right.axvline(motion.ramp_time, color="0.7", lw=0.6)
right.set(xlabel="time [s]", ylabel="tip from the clamp's axis [m]")
right.legend()
plt.show()
print(f"three blades meet the first flap, at 3ω, only at {diagram.crossings[0].omega:.3f} rad/s")
