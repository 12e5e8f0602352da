"""An atlas that maps points and curves of its plane onto the surface."""

from __future__ import annotations

from dataclasses import dataclass

from meshjig.charts.lift import curve, lift
from meshjig.charts.trimming import TrimmingCurve, trimming_curves
from meshjig.mesh.types import Atlas, Floats, Ints

__all__ = ["MappedAtlas"]


@dataclass(frozen=True)
class MappedAtlas(Atlas):
    """An atlas with the point-wise map of its charts."""

    def lift(self, chart: int, uv: Floats) -> tuple[Ints, Floats, Floats]:
        """Map points of the plane to the surface, as `meshjig.charts.lift` does."""
        return lift(self, chart, uv)

    def curve(self, chart: int, polyline: Floats) -> list[Floats]:
        """Map a polyline of the plane to the surface, as `meshjig.charts.curve` does."""
        return curve(self, chart, polyline)

    def trimming_curves(self) -> list[TrimmingCurve]:
        """Give the charts' borders with their mates, as `meshjig.charts.trimming_curves` does."""
        return trimming_curves(self)
