"""Cut a surface along planar outlines, exactly and conformingly; lay out the gap."""

from meshjig.cut.compose_cuts import Further, cut_further
from meshjig.cut.cut_curves import cut_curves
from meshjig.cut.gap_bands import gap_outlines
from meshjig.cut.merge_periodic import fold
from meshjig.cut.overlay import overlay
from meshjig.cut.transfer_pieces import carry_pieces

__all__ = ["Further", "carry_pieces", "cut_curves", "cut_further", "fold", "gap_outlines", "overlay"]
