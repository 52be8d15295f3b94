r"""Mesh convergence
================

The first natural frequency of the finite element model in steady rotation, compared with that of
the geometrically exact continuum. The error of the cable element falls with the fourth power of its
length.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, linear_modes
from rotbeam_exu import figures, natural_frequencies

plt.style.use(figures.STYLE)
beam = Beam.reference()
meshes = np.array([4, 8, 16, 32])

_, ax = plt.subplots(figsize=(6, 4))
for omega, look in ((0.0, "o-"), (4.0, "s--"), (8.0, "D:")):
    exact = linear_modes(beam, omega).frequencies[0]
    found = [natural_frequencies(beam, omega, elements=n, count=1)[0] for n in meshes]
    error = np.abs(found / exact - 1.0)
    order = -np.polyfit(np.log(meshes), np.log(error), 1)[0]
    ax.loglog(meshes, error, look, label=f"{omega:g} rad/s, order {order:.2f}")
ax.set(
    xlabel="number of elements", ylabel="relative error of $ω_n$", xticks=meshes, xticklabels=meshes
)
ax.minorticks_off()
ax.legend()
plt.show()

# %%
# The order at 8 rad/s, about twice the natural frequency of the rotating beam:
print(f"order {order:.2f}")
