"""From a drawing to a tiling: read outlines, find the translations, check the covering, find the corners."""
