"""The evaluation of a hierarchy: its arrays, the state of agents, and what a step does."""
