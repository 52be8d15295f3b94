r"""
Backbone
========

Frequency against amplitude, a panel of the paper's Fig. 14: the reduced models, the exact backbone
by harmonic balance, and six finite element runs whose amplitude follows from the ramp time.
"""

import matplotlib.pyplot as plt

from analytic import Beam, periodic_orbits
from rotbeam_exu import comparison, figures

# One process, for a gallery; without `jobs` the runs use all cores.
data = comparison.figure_14(omegas=[6.0], meshes=["paper"], jobs=1)
_, ax = plt.subplots(figsize=(5.5, 4.5), layout="constrained")
figures.figure_14(data, ax=[ax])
plt.show()

# %%
# The exact curve bends to lower frequencies: the beam softens at this speed. Its λ_ω, from two
# small orbits extrapolated to zero amplitude:
exact = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.1])
print(f"λ_ω = {exact.lambda_omega:.6f}")
