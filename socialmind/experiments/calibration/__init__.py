"""Fitting a model to data, and finding out by the same fit what such data can tell."""
