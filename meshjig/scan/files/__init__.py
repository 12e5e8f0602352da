"""Mesh files of every format, read as what they say: vertices, triangles, and what faces show."""
