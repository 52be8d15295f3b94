"""The rotating cantilever beam in Exudyn."""
