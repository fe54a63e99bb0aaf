"""The stages of a tick on a plane, at both speeds."""
