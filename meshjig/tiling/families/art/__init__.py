"""Figures that tile the plane, one a file, and the symmetries they are drawn in."""
