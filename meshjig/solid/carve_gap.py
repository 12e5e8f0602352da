"""Take the gap out of solid pieces, and repair those that cross themselves."""

from __future__ import annotations

from collections.abc import Callable, Container
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.mesh import Mesh
from meshjig.solid.crossing_pairs import at_any_corner, crossing_pairs
from meshjig.solid.cutters import cutters, round_cutters
from meshjig.solid.offsets import Offsets, Strip
from meshjig.solid.solidify import OUTER, Solid, solidify

__all__ = ["Carved", "Walls", "carve", "carved_body", "cutters_of_pairs", "taken_apart", "united"]

MainPart = Callable[[Body], tuple[Body, float, int]]  # as `largest`

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
    strays: tuple[Mesh, ...] = ()  # parts that came off though they are as large as pieces can be


class Walls(NamedTuple):
    """The walls between pieces, and how they are thickened."""

    strip: Strip
    offsets: Offsets
    pair: Ints  # (s, 2), the pieces on both sides of each quad
    half: float  # mm, of the gap


def carve(solids: dict[int, Solid], walls: Walls) -> dict[int, Carved]:
    """Subtract from every piece the walls around it, thickened to the gap.

    Parameters
    ----------
    solids : dict of Solid, by piece number
    walls : Walls

    Returns
    -------
    dict of Carved, by piece number

    Notes
    -----
    A piece that crosses itself afterwards is tried again with its slabs taken apart where they cross
    themselves, then with the folds of the solid itself mended; not where it is folded all over.
    """
    of_pair = cutters_of_pairs(walls, solids.keys())
    around: dict[int, list[tuple[int, int]]] = {i: [] for i in solids}
    for i, j in of_pair:
        for piece in {i, j} & solids.keys():
            around[piece].append((i, j))
    joined = {key: united([cutter for _, cutter in own]) for key, own in of_pair.items()}
    carved = {}
    for i, solid in solids.items():
        whole = body(solid.V, solid.F)
        first = carved_body(whole, [joined[key] for key in around[i]], "clean", largest)
        if first.state == "clean":
            carved[i] = first
            continue
        own = [cutter for key in around[i] for cutter in of_pair[key]]
        carved[i] = _carved_with_care(solid, whole, own, walls, first)
    return carved


def cutters_of_pairs(walls: Walls, chosen: Container[int]) -> dict[tuple[int, int], list[tuple[Ints, Body]]]:
    """Give the slabs between two pieces, of which one at least is chosen, with their quads."""
    of_pair: dict[tuple[int, int], list[tuple[Ints, Body]]] = {}
    for quads, cutter in cutters(walls.strip, walls.offsets, walls.half):
        i, j = walls.pair[quads[0]].tolist()
        of_pair.setdefault((i, j), []).append((quads, cutter))
    return of_pair


def _carved_with_care(
    solid: Solid, whole: Body, own: list[tuple[Ints, Body]], walls: Walls, first: Carved
) -> Carved:
    if _crossings(solid) > _HOPELESS * len(solid.F):
        return first
    parts = taken_apart(own, walls)
    tried = carved_body(whole, parts, "rounded", largest)
    if tried.state == "rounded":
        return tried
    for width in range(1, _MENDS + 1):
        repaired = repair(solid, width)
        if repaired is None:
            break
        tried = carved_body(repaired, parts, "mended", largest)
        if tried.state == "mended":
            return tried
    return first


def taken_apart(own: list[tuple[Ints, Body]], walls: Walls) -> list[Body]:
    """Give slabs, those that cross themselves quad by quad."""
    parts: list[Body] = []
    for quads, cutter in own:
        folded = len(crossing_pairs(*arrays(cutter))[0])
        parts += round_cutters(walls.strip, quads, walls.half) if folded else [cutter]
    return parts


def united(bodies: list[Body]) -> Body:
    """Give the union of bodies."""
    import manifold3d

    union = manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)
    union.num_tri()  # now, not once for each of two pieces
    return union


def carved_body(whole: Body, cutters: list[Body], state: str, main_part: MainPart) -> Carved:
    """Subtract bodies from another, and keep one part of what is left."""
    import manifold3d

    rest = manifold3d.Manifold.batch_boolean([whole, *cutters], manifold3d.OpType.Subtract)
    failed = Carved(*arrays(whole), 0.0, 0, "uncut")
    for shortest in _SHORTEST:
        main, lost, parts = main_part(rest.simplify(shortest))
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
