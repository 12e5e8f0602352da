"""Cut a surface along planar outlines, exactly and conformingly; lay out the gap."""

from meshjig.cut.compose_cuts import ComposedCut, compose_cuts
from meshjig.cut.cut_curves import cut_curves
from meshjig.cut.gap_bands import gap_outlines
from meshjig.cut.merge_periodic import merge_periodic
from meshjig.cut.overlay import overlay
from meshjig.cut.transfer_pieces import transfer_pieces

__all__ = [
    "ComposedCut",
    "compose_cuts",
    "cut_curves",
    "gap_outlines",
    "merge_periodic",
    "overlay",
    "transfer_pieces",
]
