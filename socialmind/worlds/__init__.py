"""The worlds that agents live in: grids of patches, with NetLogo's geometry, and a plane."""
