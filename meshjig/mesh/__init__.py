"""The words that every room speaks: meshes, their parts, and what is measured on them."""
