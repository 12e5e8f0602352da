"""Shapes computed from a few numbers, nothing downloaded."""
