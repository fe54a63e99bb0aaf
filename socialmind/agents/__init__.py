"""Agents as rows: how rules and users hold one, who is alive, what a run records of them."""
