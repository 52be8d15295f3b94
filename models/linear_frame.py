"""A linear model that diverges
============================

Linear elasticity in one floating frame diverges in this benchmark.

Above the beam's first natural frequency centrifugal forces exceed the bending stiffness, because
the model does not include the tension that they cause. A geometrically exact beam oscillates.
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
    linear = error.part

rate = Linearization.of(beam, spin_up.omega, element="linear").growth_rate
expected = np.sqrt(spin_up.omega**2 - beam.omega_0**2)
print(f"growth rate {rate:.5f} 1/s, √(ω² - ω_0²) = {expected:.5f} 1/s")
_, axes = plt.subplots()
inset = axes.inset_axes((0.62, 0.68, 0.38, 0.26), yscale="log", ylim=(1e-4, 1e6))
for run, look, name in ((linear, "C1--", "linear floating frame"), (exact, "k-", "exact")):
    axes.plot(run["time"], run["q"] / beam.length, look, label=name)
    inset.plot(run["time"], np.abs(run["q"]) / beam.length, look)
axes.axvspan(0.0, spin_up.ramp_time, color="0.92", lw=0, zorder=0, label="spin-up")
axes.set(xlim=(0.0, 8.0), ylim=(-2.0, 2.0), xlabel="time [s]", ylabel="tip displacement q/L")
inset.set(xlim=(0.0, 8.0), title="|q|/L")
axes.legend(loc="lower right")
plt.show()
