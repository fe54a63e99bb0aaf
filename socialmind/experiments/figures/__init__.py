"""Figures of sweeps: estimates over replicates, panels that take and return Axes, whole figures."""
