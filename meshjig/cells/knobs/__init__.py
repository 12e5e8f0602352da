"""Knobs on the borders of cells."""
