"""A judgement as one HTML page and as a JSON document."""
