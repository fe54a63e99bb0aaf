"""Cognitive schemes as the studio edits them: documents, what is odd about them, their files."""
