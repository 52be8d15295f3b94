r"""
Campbell diagram
================

In-plane frequencies of the exact beam against the speed of rotation, and the lines :math:`k\omega`
on which a force that is fixed in space excites a mode.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, campbell

diagram = campbell(Beam.reference(), np.linspace(0.0, 12.0, 25), count=3)

_, ax = plt.subplots(figsize=(6, 4.5), layout="constrained")
ax.plot(diagram.omegas, diagram.frequencies)
for order in range(1, 11):
    ax.plot(diagram.omegas, order * diagram.omegas, color="0.75", lw=0.6, zorder=0)
    if order * 12.0 > 62.0:
        ax.annotate(f"{order}ω", (62.0 / order, 62.0), color="0.45", ha="center", va="bottom")
ax.annotate("1ω", (12.0, 12.0), color="0.45", va="center")
for crossing in diagram.crossings:
    ax.plot(crossing.omega, crossing.frequency, "k.", ms=4)
ax.set(xlabel="angular velocity ω [rad/s]", ylabel="natural frequency [rad/s]", xlim=(0, 12.4))
ax.set(ylim=(0, 62))
plt.show()

# %%
# The second engine order meets the first mode here:
first = next(c for c in diagram.crossings if (c.mode, c.order) == (1, 2))
print(f"mode 1 meets 2ω at ω = {first.omega:.6f} rad/s")
