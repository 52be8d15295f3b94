r"""Thickness locking of the paper's element
========================================

The paper's element with a law that couples its strains by Poisson's ratio.

With Poisson's ratio in the law, bending strains the section across its height, which one slope
vector cannot represent. The beam bends as if :math:`E` were :math:`E/(1-\nu^2)`, on any mesh.
Without it small differences remain: shear lowers the frequency, and Green-Lagrange strains, in
rotation, raise it.
"""

import matplotlib.pyplot as plt

from analytic import Beam, linear_modes
from rotbeam_exu import figures, natural_frequencies
from rotbeam_exu.fem.elements import Ancf3

plt.style.use(figures.STYLE)
beam, omega, meshes = Beam.reference(), 6.0, [3, 4, 8, 16, 32]
exact = linear_modes(beam, omega, 1).frequencies[0]
off = {}
for law in ("uncoupled", "coupled"):
    found = [
        natural_frequencies(beam, omega, element=Ancf3(law=law), elements=n, count=1)[0]
        for n in meshes
    ]
    off[law] = found[-1] / exact - 1.0
    print(f"{law}: {found[-1]:.6f} rad/s, {off[law]:+.2e} off the exact beam")
    plt.loglog(meshes, [abs(f / exact - 1.0) for f in found], marker="o", label=law)
plt.xticks(meshes, map(str, meshes))
plt.minorticks_off()
plt.xlabel("number of elements")
plt.ylabel("error of the first frequency at 6 rad/s")
plt.legend()
plt.show()
