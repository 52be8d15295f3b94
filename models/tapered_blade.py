r"""A tapered blade on a hub: lag and flap
======================================

The Campbell diagram of the paper's beam as a blade: width and height fall to two thirds and a half
at the tip, and the hub's radius is a tenth of the length. Lag is in the plane of rotation. Out of
it, in flap, frequencies are higher: :math:`\omega_{flap}^2 \approx \omega_{lag}^2 + \omega^2`.
"""

import math

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, campbell
from rotbeam_exu import figures

plt.style.use(figures.STYLE)
blade = Beam.reference().with_taper(width=1 / 3, height=0.5).with_hub_radius(0.8)
omegas = np.linspace(0.0, 12.0, 13)
lag = campbell(blade, omegas, count=3)
flap = campbell(blade.with_setting_angle(0.5 * math.pi), omegas, count=3)
print(blade)

_, ax = plt.subplots(figsize=(6, 4.5))
lag.plot(ax, highest=66.0)
for mode, frequencies in enumerate(flap.frequencies.T, start=1):
    ax.plot(omegas, frequencies, "C1--")
    ax.annotate(
        f"flap {mode}", (12.0, frequencies[-1]), (4, 7), textcoords="offset points", color="C1"
    )
ax.plot(*np.transpose([(met.omega, met.frequency) for met in flap.crossings]), "k.", ms=4)
plt.show()

# %%
# The relation between the two holds for any inextensible blade without rotary inertia. The error
# due to the stretch and the axial motion:
gap = flap.frequencies[:, 0] ** 2 - lag.frequencies[:, 0] ** 2 - omegas**2
print(f"at most {np.abs(gap[1:] / omegas[1:] ** 2).max():.1e} of ω²")
