"""Files: beams in TOML, results in netCDF and CSV, sealed so that damage shows."""
