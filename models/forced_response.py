r"""Forced response
===============

The response to a speed ripple, :math:`\omega+\varepsilon\cos\nu t`, over its frequency, at three
damping ratios :math:`\zeta` of the moment :math:`EI(\kappa+\eta_b\dot\kappa)`. The beam hardens at
2 rad/s and softens at 6. At the folds, where the curve turns around, the response jumps; between
two folds it is unstable. The thin line, the backbone, is the free oscillation.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, Damping, SpeedRipple, forced_response, linear_modes
from rotbeam_exu import dataset_of, figures

plt.style.use(figures.STYLE)
beam, ripple = Beam.reference(), SpeedRipple(amplitude=0.002)  # [rad/s]
curves, ratios = {}, (8e-4, 1.2e-3, 2.4e-3)
for omega in (2.0, 6.0):
    drive = linear_modes(beam, omega, 1).frequencies[0] * np.array([0.993, 1.007])
    curves[omega] = [
        forced_response(
            beam.with_damping(Damping.from_ratio(beam, ratio=ratio)), omega, ripple, drive
        )
        for ratio in ratios
    ]

figure, axes = plt.subplots(ncols=2, figsize=(7.2, 3.4))
for ax, at_speed in zip(axes, curves.values(), strict=True):
    figures.forced_response([dataset_of(curve) for curve in at_speed], ax=ax).legend().remove()
handles, names = ax.get_legend_handles_labels()
names[:3] = [f"damping ratio ζ = {100.0 * ratio:.2g} %" for ratio in ratios]
figure.legend(handles, names, loc="outside lower center", ncols=3)
plt.show()

# %%
# The curve with the least damping at each speed:
for at_speed in curves.values():
    print(at_speed[0])
