r"""
A real blade: NREL's 5 MW
=========================

Its 49 stations have twist, offsets of the centers of mass and a cone, so that flap, lag and torsion
come together. Circles: frequencies by pyBModes 1.19.1, a second code, at rest and at rated speed.
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
speeds, without = np.linspace(0.0, 1.6, 5), Theory(trapeze=False)
diagram = campbell(blade, speeds, count=6, orders=3, theory=without)
known = {  # Hz
    0.0: (0.6748, 1.0824, 1.9453, 3.9934, 4.5044, 5.4535),
    rated: (0.7268, 1.0912, 2.0046, 4.0161, 4.5551, 5.4598),
}

_, ax = plt.subplots(figsize=(5.2, 4.0), layout="constrained")
diagram.plot(ax)
for omega, hertz in known.items():
    ax.plot(np.full(6, omega), 2.0 * np.pi * np.array(hertz), "o", mfc="none", color="0.3", ms=5)
ax.axvline(rated, color="0.7", lw=0.8, zorder=0)
ax.text(rated, 0.3, "rated ", color="0.45", fontsize="small", ha="right")
plt.show()
print(f"three blades meet the first flap, at 3ω, only at {diagram.crossings[0].omega:.3f} rad/s")

# %%
# The spin-up to rated speed in 4 s. The cone is pulled flat, and flap swings about it.

motion, times = SpinUp(omega=rated, ramp_time=4.0), np.linspace(0.0, 6.0, 121)
start = spin_up_response(blade, motion, times, theory=theory, tolerance=1e-6)
_, ax = plt.subplots(figsize=(3.5, 2.6), layout="constrained")
for part, look, name in ((1, "-", "lag"), (2, "--", "flap")):
    ax.plot(times, start.tip[:, part], look, label=name)
ax.axvline(motion.ramp_time, color="0.7", lw=0.6)
ax.set(xlabel="time [s]", ylabel="tip from the clamp's axis [m]")
ax.legend()
plt.show()
orbits = periodic_orbits(blade, rated, [0.05], mode="flap 1", theory=theory, functions=6)
print(f"its first flap hardens: λ_ω = {orbits.lambda_omega:.4f}")
