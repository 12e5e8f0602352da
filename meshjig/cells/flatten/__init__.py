"""Cells flattened to the plane, all of them at once."""
