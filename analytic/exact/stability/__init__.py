"""Growth out of the plane: when an orbit leaves it."""
