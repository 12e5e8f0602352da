"""Charts from the UVs that came with the file."""
