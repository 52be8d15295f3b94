"""The beam in Exudyn: formulations, drive, solver, linearization. No other room knows Exudyn."""
