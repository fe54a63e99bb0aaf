"""Episodes: genomes judged in worlds, many at once."""
