"""A run, whoever computed it: its checks, its steady oscillation, its growth. Knows no Exudyn."""
