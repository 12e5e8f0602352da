"""Thin parts of a model: where they are, and which of their sides gives pieces that reach through."""

from meshjig.thin.parts import ThroughParts, large_parts, through_parts
from meshjig.thin.ways import Ways, ways_through

__all__ = ["ThroughParts", "Ways", "large_parts", "through_parts", "ways_through"]
