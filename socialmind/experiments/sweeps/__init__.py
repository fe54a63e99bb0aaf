"""Sweeps: a model at many points of a design, with replicates, as one folder."""
