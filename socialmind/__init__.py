"""A laboratory for societies of agents."""
