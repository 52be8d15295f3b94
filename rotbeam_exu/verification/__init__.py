"""Codes judged: the measures, by which any code is, the entries of ours, and other codes."""
