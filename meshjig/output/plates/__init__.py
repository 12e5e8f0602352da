"""Pieces laid on the plates of printers."""
