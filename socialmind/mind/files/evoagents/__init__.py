"""The folders of EvoAgents (thesis, A.1 to A.4), one file a kind."""
