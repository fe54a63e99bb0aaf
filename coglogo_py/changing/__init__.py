"""A scheme that changes: by words, and what becomes of minds that have it."""
