"""Typing of rules: what every expression and statement is."""
