"""Solids as files of 32-bit floats can hold them."""
