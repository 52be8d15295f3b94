"""Files: beams in TOML, results in netCDF and in CSV."""
