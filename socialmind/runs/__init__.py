"""Runs as capsules: one folder each, that can be stopped, gone on with, replayed and read."""
