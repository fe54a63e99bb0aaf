"""Runs that go another way: what is done to a run on its way, kept with it, and its branches."""
