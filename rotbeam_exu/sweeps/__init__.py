"""Many spin-ups: the grid, the workers, the cache, and what code a cached number is from."""
