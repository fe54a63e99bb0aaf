"""Work in other processes: sent there, shared out, stopped."""
