"""Compiled code: kept in a checked folder, and modellers' own decision makers."""
