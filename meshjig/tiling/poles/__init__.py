"""How a tiling closes over the poles of a ring."""
