"""Lessons and curricula: what is taught, in which order."""
