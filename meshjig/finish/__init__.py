"""What makes a puzzle easier to build: labels on its pieces, and a core to build it on."""
