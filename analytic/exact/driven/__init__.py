"""Responses in time and to harmonic loads."""
