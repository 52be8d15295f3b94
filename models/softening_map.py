r"""Hardening and softening on a hub
================================

:math:`\lambda_\omega` of a uniform blade over hub radius and speed. A hub stiffens the rotating
blade and makes it soften at lower speed. On the dashed lines the second mode has three, four or
five times the frequency of the first, and backbones bend.
"""

import matplotlib.pyplot as plt

from rotbeam_exu import comparison, figures

data = comparison.softening_map()
figures.softening_map(data)
plt.show()

# %%
# Without a hub softening begins at this speed, in units of the root's :math:`\sqrt{EI/mL^4}`:
plain = data["lambda_omega"].sel(hub_ratio=0.0)
hardens, softens = plain.w_bar[plain < 0.0].max().item(), plain.w_bar[plain > 0.0].min().item()
print(f"between {hardens:.2f} and {softens:.2f}")
