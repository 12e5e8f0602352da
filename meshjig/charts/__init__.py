"""Mesh to Atlas: cut a surface into charts and flatten them."""

from meshjig.charts.atlas import build_atlas
from meshjig.charts.lift import curve, lift
from meshjig.charts.mapped import MappedAtlas
from meshjig.charts.trimming import TrimmingCurve, trimming_curves

__all__ = ["MappedAtlas", "TrimmingCurve", "build_atlas", "curve", "lift", "trimming_curves"]
