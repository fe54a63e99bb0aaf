"""The torus: patches on a square that wraps round, with NetLogo's geometry."""
