"""The geometrically exact beam: its modes, its periodic orbits, its response to a spin-up."""
