"""Charts found on a light proxy, and transferred to the full mesh."""
