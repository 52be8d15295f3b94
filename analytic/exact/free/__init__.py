"""Free periodic orbits: the backbone, its resonances and its series."""
