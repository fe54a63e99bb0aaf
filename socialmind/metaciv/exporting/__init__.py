"""Schemes of ours as MetaCiv's files, as far as these can hold them."""

from socialmind.metaciv.exporting.files import scheme_files
from socialmind.metaciv.exporting.schemes import Exported, for_metaciv

__all__ = ["Exported", "for_metaciv", "scheme_files"]
