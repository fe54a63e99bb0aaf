"""Imprinting: a skill learns what another already does (thesis, 5.2.3)."""
