"""What a paper takes of models and runs: ODD documents, methods, tables for other programs."""
