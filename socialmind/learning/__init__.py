"""Learning: how the genomes of a mind's skills come about."""
