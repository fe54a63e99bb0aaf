"""Optimisers: how better genomes are found from scores; `contract` says what they share."""
