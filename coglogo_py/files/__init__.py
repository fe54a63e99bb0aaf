"""The files of cognitive schemes, read within limits and written."""
