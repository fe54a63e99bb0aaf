"""Folders of MetaCiv's models, read: a description and a list of findings."""

from socialmind.metaciv.reading.folder import PARAMETERS_FILE, Reading, is_metaciv, read_folder

__all__ = ["PARAMETERS_FILE", "Reading", "is_metaciv", "read_folder"]
