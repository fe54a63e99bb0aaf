"""What decides how a model runs: its files, what they read, and whose programs run unasked."""
