"""A society as a `mesa.Model`, over the same rows."""
