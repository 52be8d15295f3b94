"""A judgment as one HTML page and as a JSON document."""
