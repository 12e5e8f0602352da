"""Which piece each face belongs to once the gap is cut out."""

import numpy as np

from meshjig.errors import CutError
from meshjig.mesh.arrays import equal_pairs
from meshjig.mesh.components import components
from meshjig.mesh.measure import barycentric, face_areas
from meshjig.mesh.types import GAP, CutMesh, Floats, Ints

__all__ = ["transfer_pieces"]


def transfer_pieces(without_gap: CutMesh, piece_of_face: Ints, with_gap: CutMesh) -> tuple[Ints, Ints]:
    """Name the parts that are left between gaps after the pieces of the same surface without gaps.

    Parameters
    ----------
    without_gap : CutMesh
    piece_of_face : (m,) int64, for the faces of without_gap
    with_gap : CutMesh, of the same mesh; its gap faces have the label GAP

    Returns
    -------
    piece : (k,) int64, for the faces of with_gap; GAP for the gap and for specks
    speck : (s,) int64, faces of parts that the gap cut off from their piece

    Raises
    ------
    CutError
        A piece has vanished in the gap.
    """
    solid = np.flatnonzero(with_gap.label != GAP)
    F = with_gap.F[solid]
    n_parts, part = components(F)
    area = face_areas(with_gap.V, F)
    order = np.lexsort((area, part))
    last = np.append(np.flatnonzero(np.diff(part[order])), len(order) - 1)
    chosen = order[last]  # the largest face of every part
    part_area = np.bincount(part, area, n_parts)
    middle = with_gap.V[F[chosen]].mean(1)
    name = _piece_at(without_gap, piece_of_face, with_gap.parent[solid[chosen]], middle)
    n_pieces = int(piece_of_face.max()) + 1
    main = np.full(n_pieces, -1)
    by_area = np.argsort(part_area, kind="stable")
    main[name[by_area]] = by_area
    lost = np.flatnonzero(main < 0)
    if len(lost):
        raise CutError(
            f"{len(lost)} of {n_pieces} pieces are narrower than the clearance and vanish in the gap",
            hint="use fewer pieces or a smaller clearance",
            ids=lost.tolist(),
        )
    piece = np.full(len(with_gap.F), GAP)
    kept = main[name[part]] == part
    piece[solid[kept]] = name[part[kept]]
    return piece, solid[~kept]


def _piece_at(cut: CutMesh, piece_of_face: Ints, parent: Ints, points: Floats) -> Ints:
    """Find the pieces of points in given faces of the mesh, (k,) int64."""
    row, face = equal_pairs(parent, cut.parent)
    inside = barycentric(cut.V, cut.F, face, points[row]).min(1)
    best = np.lexsort((inside, row))
    last = np.append(np.flatnonzero(np.diff(row[best])), len(best) - 1)
    return piece_of_face[face[best[last]]]
