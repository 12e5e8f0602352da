"""The viewer: one HTML file that shows a puzzle in 3D."""
