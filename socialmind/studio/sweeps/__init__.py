"""Sweeps as the page shows them: how far they came, what failed, and their figures."""
