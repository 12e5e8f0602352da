"""What the oracle does: record what puzzles are, and compare them."""
