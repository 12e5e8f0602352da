"""Meshes, lines and reports as files, and read back from them."""
