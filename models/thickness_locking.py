r"""Thickness locking of the paper's element
========================================

The paper's element with a law that couples its strains by Poisson's ratio.

With Poisson's ratio in the law, bending strains the section across its height, which one slope
vector cannot represent. The beam bends as if :math:`E` were :math:`E/(1-\nu^2)`, on any mesh: the
dotted line. The element shears, so errors are relative to the beam with shear, here at rest:
in rotation the element's Green-Lagrange strains add 5e-5.
"""

from dataclasses import replace

import matplotlib.pyplot as plt

from analytic import Beam, linear_modes
from rotbeam_exu import figures, natural_frequencies
from rotbeam_exu.fem.elements import Ancf3

plt.style.use(figures.STYLE)
beam, omega, meshes = Beam.reference(), 0.0, [3, 4, 8, 16]
stiff = replace(beam, youngs_modulus=beam.youngs_modulus / (1.0 - Ancf3().poisson_ratio ** 2))
exact, locked = (
    linear_modes(one, omega, 1, theory=Ancf3().theory).frequencies[0] for one in (beam, stiff)
)
off = {}
for law, mark in (("uncoupled", "o-"), ("coupled", "s--")):
    element = Ancf3(law=law)
    found = [natural_frequencies(beam, omega, element=element, elements=n)[0] for n in meshes]
    off[law] = found[-1] / exact - 1.0
    print(f"{law}: {found[-1]:.6f} rad/s, {off[law]:+.2e} off the exact beam with shear")
    name = "law coupled by ν = 0.3" if law == "coupled" else "law without coupling"
    plt.loglog(meshes, [abs(f / exact - 1.0) for f in found], mark, label=name)
plt.axhline(locked / exact - 1.0, color="black", ls=":", label="exact beam of $E/(1-ν^2)$")
plt.gca().set(xticks=meshes, xticklabels=meshes, xlabel="number of elements")
plt.minorticks_off()
plt.ylabel("error of the first frequency at rest")
plt.legend()
plt.show()
