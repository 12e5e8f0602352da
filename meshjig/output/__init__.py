"""Write a puzzle: meshes for printers, pictures for people, a report for both."""
