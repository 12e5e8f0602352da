"""Count what outlines draw once on each side of a closing line as one."""

from dataclasses import replace

import numpy as np

from meshjig.mesh.types import CutMesh, Outlines

__all__ = ["merge_periodic"]


def merge_periodic(cut: CutMesh, outlines: Outlines) -> CutMesh:
    """Name cuts and points of copies after the first copy.

    On a periodic chart a curve over the closing line is drawn twice, a period apart, and either
    copy lies on the surface in part. Folded, the parts of a segment add up to the whole segment, and
    a point has its vertex whichever copy was cut there.

    Parameters
    ----------
    cut : CutMesh, made along the outlines
    outlines : Outlines

    Returns
    -------
    CutMesh
        Its cuts are no longer those of the segments in the plane: for counting only. The same cut
        mesh where the outlines have no copies.
    """
    if outlines.same_point is None or outlines.same_segment is None:
        return cut
    vertex = np.full(len(cut.point_vertex), -1)
    np.maximum.at(vertex, outlines.same_point, cut.point_vertex)
    return replace(
        cut,
        point_vertex=vertex[outlines.same_point],
        cut_segment=outlines.same_segment[cut.cut_segment],
    )
