"""Folders of MetaCiv's models, read: a description and a list of findings."""

from socialmind.metaciv.reading.folder import Reading, read_folder

__all__ = ["Reading", "read_folder"]
