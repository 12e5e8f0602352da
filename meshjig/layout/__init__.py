"""A surface cut into pieces at zero width: as cells or as tiles, and with knobs over seams."""
