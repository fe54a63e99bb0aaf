"""A running society: what was declared, and its agents as rows of arrays."""
