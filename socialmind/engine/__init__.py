"""The ticks of a running society, compiled or interpreted with the same results."""
