"""Pictures by ray casting, and what is drawn on them."""
