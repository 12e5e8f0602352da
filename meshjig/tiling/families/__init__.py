"""Tilings, one file a family; each function gives the unit that is repeated."""
