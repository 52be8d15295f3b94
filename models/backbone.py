r"""Backbone
========

Frequency over amplitude, a panel of the paper's Fig. 14: the reduced models, the exact backbone by
harmonic balance, and three finite element spin-ups with different ramp times.
"""

import matplotlib.pyplot as plt

from analytic import Beam, periodic_orbits
from rotbeam_exu import comparison, figures

# One process, for the gallery; without `jobs` the runs use all cores.
data = comparison.figure_14(omegas=[6.0], ramp_times=[2.5, 2.75, 3.25], meshes=["paper"], jobs=1)
figures.figure_14(data)
plt.show()

# %%
# The exact curve bends to lower frequencies: the beam softens at this speed. The coefficient
# :math:`\lambda_\omega` of :math:`\omega_{NL}=\omega_n(1-\lambda_\omega a^2)` is extrapolated from
# two small orbits to zero amplitude:
exact = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.1])
print(f"λ_ω = {exact.lambda_omega:.6f}")
