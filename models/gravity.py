r"""A rotating beam under gravity
=============================

The paper's beam in a vertical plane of rotation, with an external damping of
:math:`d\,\dot{\mathbf r}` per length, where the velocity is that in the turning frame. Gravity
excites harmonics of all orders. The k-th is greatest near :math:`\omega_n=k\omega` (dotted). Above
is the greatest deflection to either side, below are the harmonics.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, Damping, Gravity, campbell, forced_response
from rotbeam_exu import dataset_of, figures

plt.style.use(figures.STYLE)
beam = Beam.reference()
damping = Damping(external=1.5 * beam.mass_per_length * beam.frequency_scale)
response = forced_response(beam.with_damping(damping), np.linspace(0.4, 6.0, 85), Gravity())
crossings = campbell(beam, np.linspace(0.0, 6.0, 25), count=1, orders=4).crossings

_, (above, below) = plt.subplots(nrows=2, figsize=(6, 6), sharex=True)
figures.forced_response(dataset_of(response), ax=above)
above.get_legend().remove()
above.set(xlabel="", xlim=(0.4, 6.0))
for k in range(1, 5):
    (line,) = below.semilogy(response.omega, np.abs(response.harmonics[:, k]))
    size = np.interp(4.6, response.omega, np.abs(response.harmonics[:, k]))
    below.annotate(
        f"k = {k}", (4.6, size), (4, 4), textcoords="offset points", color=line.get_color()
    )
below.set(xlabel="rotation speed ω [rad/s]", ylabel="harmonic k of q/L")
for crossing in crossings:
    for ax in (above, below):
        ax.axvline(crossing.omega, color="0.6", ls=":", lw=0.8)
    above.annotate(f"{crossing.order}ω", (crossing.omega + 0.02, 0.01), color="0.45", size=7)
plt.show()

# %%
# The speed at which each harmonic is greatest, and its resonance:
for crossing in reversed(crossings):
    greatest = response.omega[np.argmax(np.abs(response.harmonics[:, crossing.order]))]
    print(f"{crossing.order}: {greatest:.2f} rad/s, ω_n = kω at {crossing.omega:.4f} rad/s")
