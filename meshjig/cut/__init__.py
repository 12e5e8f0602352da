"""Cut a surface along planar outlines, exactly and conformingly; lay out the gap."""

from meshjig.cut.carry import carry_pieces
from meshjig.cut.clearance import gap_outlines
from meshjig.cut.curves import cut_curves
from meshjig.cut.fold import fold
from meshjig.cut.further import Further, cut_further
from meshjig.cut.overlay import overlay

__all__ = ["Further", "carry_pieces", "cut_curves", "cut_further", "fold", "gap_outlines", "overlay"]
