"""A submission as files: read with all faults told at once, and written so that it reads back."""
