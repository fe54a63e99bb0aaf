"""Futures side by side: the series of runs, how they differ, and a figure of it."""
