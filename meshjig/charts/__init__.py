"""Mesh to Atlas: cut a surface into charts and flatten them."""

from meshjig.charts.atlas import MappedAtlas, build_atlas
from meshjig.charts.cuts import TrimmingCurve, trimming_curves
from meshjig.charts.lift import curve, lift

__all__ = ["MappedAtlas", "TrimmingCurve", "build_atlas", "curve", "lift", "trimming_curves"]
