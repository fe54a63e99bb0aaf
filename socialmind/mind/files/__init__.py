"""The files of minds: the folders of EvoAgents (thesis, A.1 to A.4), one YAML form, and weights."""
