"""Files: beams in TOML, results in netCDF, sealed so that damage shows, and in CSV."""
