r"""A million points of the exact backbone
======================================

A series through nine exact orbits gives a million amplitudes in milliseconds. It is compared with
perturbation theory, which needs no orbit, to third order (FrM) and to fifth (FrM5). The shift is
that of the frequency from its value at small amplitude, :math:`\omega_n`.
"""

import time

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, backbone_curve, periodic_orbits, reduced_model
from rotbeam_exu import figures

plt.style.use(figures.STYLE)
beam, omega = Beam.reference(), 6.0
curve = backbone_curve(beam, omega)
a = np.linspace(0.0, curve.holds_up_to, 1_000_000)
start = time.perf_counter()
ratio = curve.frequency(a) / curve.omega_n
print(f"{curve}\na million of them in {1e3 * (time.perf_counter() - start):.0f} ms")

shift, peak = 1.0 - ratio[::20_000], a[::20_000]
orbits = periodic_orbits(beam, omega, [0.15, 0.3, 0.45, 0.58])
_, (left, right) = plt.subplots(1, 2, figsize=(7.2, 3.2))
left.plot(ratio[::1000], a[::1000], "k-", label="exact, a series")
left.plot(orbits.frequency / orbits.omega_n, orbits.amplitude, "ko", mfc="w", label="exact orbits")
for name, style in (("FrM", "C0--"), ("FrM5", "C3-.")):
    model = reduced_model(beam, omega, name)
    said = model.lambda_omega * peak**2 + model.kappa_of_peak * peak**4
    left.plot(1.0 - said, peak, style, label=name)
    right.semilogy(peak[4:], 100.0 * np.abs(said / shift - 1.0)[4:], style)
left.set(xlabel=r"$\omega_{NL}/\omega_n$", ylabel="peak $|q|/L$", title="ω = 6 rad/s")
left.legend(loc="lower left")
right.set(xlabel="peak $|q|/L$", ylabel="error of the shift [%]", ylim=(1e-2, 30.0))
plt.show()
