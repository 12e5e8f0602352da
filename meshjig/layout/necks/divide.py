"""What hangs on a piece by so little that it would come off: a neighbour gets it."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from meshjig.layout.necks.neck_prefilter import could_have_necks
from meshjig.layout.necks.width_components import width_components
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.types import CutMesh, Stitching

__all__ = ["divide_at_necks"]

SPECK = 1.0  # squares of the width; what is smaller and comes off is not missed
ROUNDS = 6  # what was handed over may hang on by little again


def divide_at_necks(
    cut: CutMesh, stitching: Stitching, width: float, smallest: float
) -> tuple[CutMesh, Stitching]:
    """Take from pieces what hangs on them by a neck.

    It goes to the neighbour with which it has the longest border; what is large enough becomes a piece.

    Parameters
    ----------
    cut : CutMesh
    stitching : Stitching, of its regions
    width : float, mm, of a neck at most; 0 for none
    smallest : float, share of the mean area under which a part is too small to be a piece

    Returns
    -------
    cut : CutMesh, its regions divided where pieces are
    stitching : Stitching
    """
    handed_over = parted = 0
    piece, area = stitching.piece_of_region[cut.region], face_areas(cut.V, cut.F)
    limits = _Limits(width, smallest * float(area.sum()) / max(stitching.n_pieces, 1))
    e = edges(cut.F)
    narrow = could_have_necks(cut.V, cut.F, e, piece, width) if width > 0 else np.zeros(0, bool)
    for _ in range(ROUNDS):
        if not narrow.any():
            break
        before = piece
        piece, handed, new = _without_necks(cut, e, piece, narrow[piece], area, limits)
        handed_over, parted = handed_over + handed, parted + new
        narrow = np.bincount(piece, piece != before) > 0
    facts = replace(stitching.facts, handed_over=handed_over, parted=parted)
    if (piece == stitching.piece_of_region[cut.region]).all():
        return cut, replace(stitching, facts=facts)
    both = cut.region * np.int64(piece.max() + 1) + piece
    n, region = components(cut.F, np.repeat(both, 3) != both[e.twin // 3], e.twin)
    piece_of_region = np.zeros(n, np.int64)
    piece_of_region[region] = np.unique(piece, return_inverse=True)[1]
    return replace(cut, region=region), Stitching(piece_of_region, facts)


class _Limits(NamedTuple):
    width: float  # mm, of a neck at most
    least: float  # mm2, under which a part is too small to be a piece


def _without_necks(
    cut: CutMesh, e: Edges, piece: Ints, asked: Bools, area: Floats, limits: _Limits
) -> tuple[Ints, int, int]:
    """Give the piece of every face, (m,), once what is beyond necks of the pieces asked has a new one.

    Also count the parts that went to a neighbour, and those that became pieces.
    """
    width, handed_over, parted = limits.width, 0, 0
    part = piece.copy()
    part[asked] = int(piece.max()) + 1 + width_components(cut.V, cut.F[asked], piece[asked], width)
    n = int(part.max()) + 1
    size, owner = sums(part, area, n), np.zeros(n, np.int64)
    owner[part] = piece
    by_size = np.lexsort((size, owner))
    main = by_size[np.append(np.diff(owner[by_size]) > 0, True)]  # the largest part of every piece
    size[main] = 0.0
    beyond = np.flatnonzero(size > SPECK * width**2)
    border = _borders(cut, e, part, owner, beyond)
    new = owner.copy()
    for k in beyond[np.argsort(-size[beyond], kind="stable")].tolist():
        longest, neighbour = max(((mm, -p) for p, mm in border[k].items()), default=(0.0, 0))
        if size[k] >= limits.least:
            new[k] = new.max() + 1
            parted += 1
        elif longest > width:
            new[k] = -neighbour
            handed_over += 1
    return new[part], handed_over, parted


def _borders(cut: CutMesh, e: Edges, part: Ints, owner: Ints, wanted: Ints) -> dict[int, dict[int, float]]:
    """Give the neighbours of some parts, other than their piece, and the length of the border, mm."""
    h = np.flatnonzero(np.repeat(np.isin(part, wanted), 3))
    here, there = part[h // 3], owner[part[e.twin[h] // 3]]
    kept = owner[here] != there
    ends = cut.V[e.E[e.edge_of_halfedge[h[kept]]]]
    found: dict[int, dict[int, float]] = {int(k): {} for k in wanted}
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    for k, p, mm in zip(here[kept].tolist(), there[kept].tolist(), length.tolist(), strict=True):
        found[k][p] = found[k].get(p, 0.0) + mm
    return found
