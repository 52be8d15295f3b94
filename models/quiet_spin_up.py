r"""A ramp without residual vibration
=================================

To 6 rad/s in 4 s: the ramp of the paper, Eq. 1, and one whose acceleration has a few more
harmonics, designed so that the first two modes are at rest when it ends. The robust one forgives a
wrong frequency of the blade too. All are computed by finite elements, which are independent of the
design.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, SpinUp, design_ramp, residual_amplitude
from rotbeam_exu import figures, simulate

plt.style.use(figures.STYLE)
beam, T = Beam.reference(), 4.0
ramps = {
    "Eq. 1": SpinUp(omega=6.0, ramp_time=T),
    "designed": design_ramp(beam, omega=6.0, duration=T),
    "robust": design_ramp(beam, omega=6.0, duration=T, robust=1),
}

_, (above, below) = plt.subplots(nrows=2, sharex=True, figsize=(6, 5))
left, way = {}, {}
looks = dict(zip(ramps, ("C0-", "C1--", "C2-."), strict=True))
for name, ramp in ramps.items():
    run = simulate(beam, ramp, duration=10.0)
    left[name] = 0.5 * np.ptp(run["q"].sel(time=slice(T, None)).to_numpy()) / beam.length
    way[name] = np.abs(run["q"]).max().item() / beam.length
    above.plot(run["time"], ramp.acceleration(run["time"].to_numpy()), looks[name], label=name)
    below.plot(run["time"], run["q"] / beam.length, looks[name])
above.set(ylabel="acceleration [rad/s²]")
above.legend()
below.set(xlabel="time [s]", ylabel="tip displacement q/L", xlim=(0.0, 10.0))
plt.show()

# %%
# Half peak to peak after the ramp, and the largest deflection on the way, over the length;
# ``largest=0.3`` in ``design_ramp`` bounds the latter:
print({name: f"{size:.1e}, {way[name]:.2f}" for name, size in left.items()})

# %%
# Residual vibration of a blade whose frequency is not the one designed for, by the exact
# transient: the error's first power for the designed ramp, its second for the robust one.
errors = np.linspace(-0.04, 0.04, 13)
_, axes = plt.subplots(figsize=(5, 3))
for name, ramp in ramps.items():
    others = [beam.in_units(length=1.0, mass=1.0, time=1.0 + error) for error in errors]
    amplitudes = [residual_amplitude(one, ramp, exact=True) for one in others]
    axes.semilogy(100.0 * errors, amplitudes, looks[name], label=name)
axes.set(xlabel="error of the frequency [%]", ylabel="residual amplitude / L")
axes.legend()
plt.show()
