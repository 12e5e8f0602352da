"""Benchmarks of single stages."""
