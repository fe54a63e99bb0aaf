"""The ODD document of a model: made of declarations, docstrings and its author's words."""
