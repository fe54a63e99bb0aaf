"""Worlds of patches of any shape, with walls or none, and NetLogo's geometry."""
