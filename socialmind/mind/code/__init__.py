"""The programs of a mind as code: typed, and written into a compiled module."""
