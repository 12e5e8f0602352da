"""A folder that appears whole or not at all, and takes nothing of a user's with it."""

from meshjig.output.folder.replace import replace_folder, reserve_folder

__all__ = ["replace_folder", "reserve_folder"]
