"""Charts found on a proxy with few faces, and transferred to the full mesh."""
