"""Cut a surface along planar outlines, exactly and conformingly; lay out the gap."""

from meshjig.cut.carry import carry_pieces
from meshjig.cut.clearance import gap_outlines
from meshjig.cut.curves import cut_curves
from meshjig.cut.fold import fold
from meshjig.cut.overlay import overlay

__all__ = ["carry_pieces", "cut_curves", "fold", "gap_outlines", "overlay"]
