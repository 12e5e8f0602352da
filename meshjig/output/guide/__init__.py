"""The guide: a PDF that shows how to put a puzzle together."""
