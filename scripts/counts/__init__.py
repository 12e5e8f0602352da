"""What the structure of a package is counted by."""
