"""A linear model that diverges
============================

Linear elasticity in one floating frame diverges in this benchmark.

Above the beam's first natural frequency centrifugal forces exceed the bending stiffness, because
the model does not include the tension that they cause. A geometrically exact beam oscillates. The
thin line is its length.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, SpinUp
from rotbeam_exu import SimulationError, figures, simulate
from rotbeam_exu.fem.linearization import Linearization

plt.style.use(figures.STYLE)
beam, spin_up = Beam.reference(), SpinUp(omega=4.0, ramp_time=3.0)
job = {"duration": 8.0, "step": 2e-3, "frame": "rotating"}
exact = simulate(beam, spin_up, element="exact", **job)
try:
    linear = simulate(beam, spin_up, element="linear", **job)
except SimulationError as error:
    print(error)
    linear = error.run

rate = Linearization.of(beam, spin_up.omega, element="linear").growth_rate
expected = np.sqrt(spin_up.omega**2 - beam.omega_0**2)
print(f"growth rate {rate:.5f} 1/s, √(ω² - ω_0²) = {expected:.5f} 1/s")
for run, name in ((linear, "linear floating frame"), (exact, "geometrically exact")):
    plt.semilogy(run["time"], np.abs(run["q"]) / beam.length, label=name)
plt.axhline(1.0, color="0.6", lw=0.5)
plt.ylim(1e-4, 1e6)
plt.xlabel("time [s]")
plt.ylabel("|q| / L")
plt.legend()
plt.show()
