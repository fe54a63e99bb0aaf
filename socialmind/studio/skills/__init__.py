"""Minds of skills as documents that pages edit: read, checked, and written where changed."""
