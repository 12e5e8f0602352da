"""Take the gap out of solid pieces, and repair those that cross themselves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.solid.crossing_pairs import at_any_corner, crossing_pairs
from meshjig.solid.cutters import cutters, round_cutters
from meshjig.solid.offsets import Offsets, Strip
from meshjig.solid.solidify import OUTER, Solid, solidify

__all__ = ["Carved", "carve"]

# mm; details of the booleans below this are dissolved: the first, or a later one where pieces would cross
_SHORTEST = (0.003, 0.005, 0.01)
_DEPTH = 0.005  # mm; shallower crossings are rounding
_HOPELESS = 0.1  # pairs that cross, a face: a piece of a surface that is folded all over is not mended
_MENDS = 3  # tries, each with a wider region


class Carved(NamedTuple):
    """A piece with its gap."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    lost: float  # mm3, parts that came off and were left out
    parts: int  # how many those were
    state: str  # "clean", "rounded" or "mended": what it took; "crosses" or "uncut": what failed


def carve(
    solids: dict[int, Solid], strip: Strip, offsets: Offsets, pair: Ints, clearance: float
) -> dict[int, Carved]:
    """Subtract from every piece the walls around it, thickened to the gap.

    Parameters
    ----------
    solids : dict of Solid, by piece number
    strip, offsets : the walls, and how they are thickened
    pair : (s, 2) int64, the pieces on both sides of each quad
    clearance : float, mm

    Returns
    -------
    dict of Carved, by piece number

    Notes
    -----
    A piece that crosses itself afterwards is tried again with its slabs taken apart where they cross
    themselves, then with the folds of the solid itself mended; not where it is folded all over.
    """
    made = cutters(strip, offsets, clearance / 2)
    of_pair: dict[tuple[int, int], list[tuple[Ints, Body]]] = {}
    for quads, cutter in made:
        i, j = pair[quads[0]].tolist()
        of_pair.setdefault((i, j), []).append((quads, cutter))
    around: dict[int, list[tuple[int, int]]] = {i: [] for i in solids}
    for i, j in of_pair:
        for piece in {i, j} & solids.keys():
            around[piece].append((i, j))
    joined = {key: _union([cutter for _, cutter in own]) for key, own in of_pair.items()}
    carved = {}
    for i, solid in solids.items():
        whole = body(solid.V, solid.F)
        first = _carved(whole, [joined[key] for key in around[i]], "clean")
        if first.state == "clean":
            carved[i] = first
            continue
        own = [cutter for key in around[i] for cutter in of_pair[key]]
        carved[i] = _carved_with_care(solid, whole, own, strip, clearance / 2, first)
    return carved


def _carved_with_care(
    solid: Solid, whole: Body, own: list[tuple[Ints, Body]], strip: Strip, half: float, first: Carved
) -> Carved:
    if _crossings(solid) > _HOPELESS * len(solid.F):
        return first
    parts: list[Body] = []
    for quads, cutter in own:
        folded = len(crossing_pairs(*arrays(cutter))[0])
        parts += round_cutters(strip, quads, half) if folded else [cutter]
    tried = _carved(whole, parts, "rounded")
    if tried.state == "rounded":
        return tried
    for width in range(1, _MENDS + 1):
        repaired = repair(solid, width)
        if repaired is None:
            break
        tried = _carved(repaired, parts, "mended")
        if tried.state == "mended":
            return tried
    return first


def _union(bodies: list[Body]) -> Body:
    import manifold3d

    union = manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)
    union.num_tri()  # now, not once for each of two pieces
    return union


def _carved(whole: Body, cutters: list[Body], state: str) -> Carved:
    import manifold3d

    rest = manifold3d.Manifold.batch_boolean([whole, *cutters], manifold3d.OpType.Subtract)
    failed = Carved(*arrays(whole), 0.0, 0, "uncut")
    for shortest in _SHORTEST:
        main, lost, parts = largest(rest.simplify(shortest))
        if not sound(main):
            continue
        made = Carved(*arrays(main), lost, parts, state)
        n = _crossings(made)
        if not n:
            return made
        if failed.state == "uncut":
            failed = made._replace(state="crosses")
        if n > _HOPELESS * len(made.F):
            break
    return failed


def _crossings(piece: Carved | Solid) -> int:
    """Count the pairs of faces that cross deeper than rounding."""
    return int((crossing_pairs(piece.V, piece.F)[1] > _DEPTH).sum())


def repair(solid: Solid, width: int) -> Body | None:
    """Replace the folded part of a piece by a union of prisms, one under each outer face.

    Parameters
    ----------
    solid : Solid
    width : int, how many rings of faces around a crossing are replaced

    Returns
    -------
    body, or None when the solid crosses itself nowhere
    """
    import manifold3d

    crossing = crossing_pairs(solid.V, solid.F)[0]
    if not len(crossing):
        return None
    m = int((solid.kind == OUTER).sum())
    n = len(solid.V) // 2
    outer, X, Y = solid.F[:m], solid.V[:n], solid.V[n:]
    folded = np.zeros(n, bool)
    folded[solid.F[crossing.ravel()].ravel() % n] = True
    for _ in range(width - 1):
        folded[outer[at_any_corner(folded, outer)]] = True
    region = at_any_corner(folded, outer)
    prisms = [manifold3d.Manifold.hull_points(np.concatenate([X[face], Y[face]])) for face in outer[region]]
    bodies = [prism for prism in prisms if sound(prism)]
    if not region.all():
        rest = solidify(X, outer[~region], np.zeros(int((~region).sum()), np.int64), Y - X)[0][0]
        bodies.append(body(rest.V, rest.F))
    return manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)
