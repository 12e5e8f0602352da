"""Pieces that reach through thin parts, cut out of the wall of the whole model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.halfedges import border_halfedges, compact
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.pieces import Pieces
from meshjig.solid.border_chains import Chains, edge_lines
from meshjig.solid.carve_gap import Carved, Walls, carved_body, cutters_of_pairs, taken_apart, united
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.separate import separate
from meshjig.solid.solidify import OUTER, Solid, solidify

__all__ = ["Rim", "Sheet", "Stock", "carve_marked", "carve_through", "joined_lines", "rim_lines", "separated"]

_AROUND = 8.0  # mm, that a piece may be larger than what lies under its faces
_ON = 0.02  # mm; a point this near to a body lies on it
_RAISED = 0.02  # mm, that what belongs to others begins above their faces: no two faces fall together
_COARSER = (0.02, 0.04)  # mm; details that are dissolved where a piece would cross itself otherwise
_DEPTH = 0.005  # mm; shallower crossings are rounding
_STRAY = 2.0  # mm3, of a part that is worth keeping
_MARKS = 60  # points of a piece's faces that tell which part is the piece


class Rim(NamedTuple):
    """Edges where a far side meets a piece that does not reach through there."""

    tail: Ints  # (k,), vertices
    head: Ints  # (k,)
    piece: Ints  # (k,), that piece
    behind: Ints  # (k,), the piece that reaches through behind it


class Sheet(NamedTuple):
    """Faces with the pieces that they belong to, and how deep these go below them."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    piece: Ints  # (m,)
    D: Floats  # (n, 3), mm

    def near(self, low: Floats, high: Floats) -> Sheet:
        """Give the faces within a box."""
        P = self.V[self.F]
        kept = ((P.max(axis=1) > low) & (P.min(axis=1) < high)).all(axis=1)
        F, vertex = compact(self.F[kept])
        return Sheet(self.V[vertex], F, self.piece[kept], self.D[vertex])

    def away_from(self, points: Floats, far: float) -> Sheet:
        """Give the faces without a corner near to some points."""
        from scipy.spatial import cKDTree

        if far <= 0 or not len(points) or not len(self.F):
            return self
        near = np.isfinite(cKDTree(points).query(self.V, distance_upper_bound=far)[0])
        F, vertex = compact(self.F[~near[self.F].any(axis=1)])
        return Sheet(self.V[vertex], F, self.piece[~near[self.F].any(axis=1)], self.D[vertex])

    def body(self, of: Bools) -> Body:
        """Give what lies below some of the faces, from a little above them."""
        raised = _RAISED * unit(self.D)
        made = solidify(self.V - raised, self.F, np.where(of, 0, -1), self.D + raised)[0]
        return body(*made[0][:2]) if made else body(np.empty((0, 3)), np.empty((0, 3), np.int64))


@dataclass(frozen=True)
class Stock:
    """What pieces that reach through are cut from, and what of it belongs to others."""

    wall: Mesh  # of the whole model: its shell, and thin parts without a hollow
    reaches: Bools  # (p,), pieces that reach through
    rim: Rim
    shells: tuple[Sheet, ...]  # of what is laid out, what is filled below it, and far sides by who is behind
    through: Sheet  # faces under which pieces reach through, and how deep
    past: Floats  # (n,), mm, how far walls go past the rim of the surface that is laid out


def rim_lines(rim: Rim) -> Chains:
    """Give the edges along a rim as lines, each between the piece before it and the one behind."""
    kept = rim.piece != rim.behind
    pair = np.sort(np.stack([rim.piece, rim.behind], 1)[kept], axis=1)
    return edge_lines(rim.tail[kept], rim.head[kept], pair)


def joined_lines(first: Chains, second: Chains) -> Chains:
    """Put lines one behind the other."""
    return Chains(
        np.concatenate([first.vertex, second.vertex]),
        np.concatenate([first.start, second.start[1:] + len(first.vertex)]),
        np.concatenate([first.pair, second.pair]),
    )


def carve_through(
    solids: dict[int, Solid], walls: Walls, stock: Stock, lean: float = 0.0
) -> dict[int, Carved]:
    """Cut pieces out of the wall of the whole model, along the walls around them.

    Parameters
    ----------
    solids : dict of Solid, by piece number; their outer faces tell where a piece is
    walls : Walls
    stock : Stock
    lean : float, mm
        How far walls may go below the ground of others, who claim nothing so near to them.

    Returns
    -------
    dict of Carved, by piece number
    """
    wall, starts = body(*stock.wall), {}
    for i, solid in solids.items():
        low, high = solid.V.min(0) - _AROUND, solid.V.max(0) + _AROUND
        along = walls.strip.corners[(walls.pair == i).any(axis=1)].reshape(-1, 3)
        start = _without(_within(wall, low, high), _of_others(stock, i, low, high, along, lean))
        starts[i] = start, _marks(solid)
    return carve_marked(starts, walls)


def carve_marked(starts: dict[int, tuple[Body, Floats]], walls: Walls) -> dict[int, Carved]:
    """Cut pieces out of larger bodies, along the walls around them.

    Parameters
    ----------
    starts : dict of body and (k, 3) float64, mm, by piece number
        What each is cut from, and points on its skin that tell which part is the piece.
    walls : Walls

    Returns
    -------
    dict of Carved, by piece number
    """
    of_pair = cutters_of_pairs(walls, starts.keys())
    joined = {key: united([cutter for _, cutter in own]) for key, own in of_pair.items()}
    keys_of: dict[int, list[tuple[int, int]]] = {i: [] for i in starts}
    for key in of_pair:
        for i in set(key) & starts.keys():
            keys_of[i].append(key)
    carved = {}
    for i, (start, marks) in starts.items():
        keys = keys_of[i]
        strays: list[Mesh] = []

        def own_part(
            rest: Body, marks: Floats = marks, strays: list[Mesh] = strays
        ) -> tuple[Body, float, int]:
            main, others = _marked(rest, marks)
            strays[:] = [Mesh(*arrays(part)) for part in others if part.volume() > _STRAY]
            return main, float(sum(part.volume() for part in others)), len(others)

        first = carved_body(start, [joined[key] for key in keys], "clean", own_part)
        if first.state != "clean":
            parts = taken_apart([cutter for key in keys for cutter in of_pair[key]], walls)
            again = carved_body(start, parts, "rounded", own_part)
            first = again if again.state == "rounded" else _coarser(first)
        carved[i] = first._replace(strays=tuple(strays))
    return carved


def _coarser(piece: Carved) -> Carved:
    """Dissolve larger details of a piece until it does not cross itself, if that helps."""
    if piece.state != "crosses":
        return piece
    for shortest in _COARSER:
        main, _, _ = largest(body(piece.V, piece.F).simplify(shortest))
        V, F = arrays(main)
        if sound(main) and not (crossing_pairs(V, F)[1] > _DEPTH).any():
            return piece._replace(V=V, F=F, state="rounded")
    return piece


def separated(carved: dict[int, Carved], stock: Stock, clearance: float) -> dict[int, Carved]:
    """Make room where a piece that reaches through is too near to another; gives those that have changed."""
    numbers = sorted(carved)
    names = [str(i) for i in numbers]
    pieces = Pieces(tuple(names), tuple(Mesh(carved[i].V, carved[i].F) for i in numbers))
    pairs = np.array(numbers)[pieces.close(clearance)].reshape(-1, 2)
    pairs = pairs[stock.reaches[pairs].any(axis=1)]
    changed = separate(dict(zip(numbers, pieces, strict=True)), pairs, clearance)
    return {i: carved[i]._replace(V=V, F=F) for i, (V, F) in changed.items()}


def _of_others(stock: Stock, i: int, low: Floats, high: Floats, along: Floats, lean: float) -> list[Body]:
    """Give what belongs to other pieces: where several claim it, to who reaches through, the first first.

    Nothing within `lean` of the points along a piece's own walls, (k, 3), is claimed.
    """
    deep = stock.through.near(low, high)
    own = deep.body(deep.piece == i)
    later = [deep.body(deep.piece > i)]
    for sheet in stock.shells:
        shell = sheet.near(low, high).away_from(along, lean)
        later.append(shell.body((shell.piece != i) & (shell.piece >= 0)))
    return [deep.body((deep.piece < i) & (deep.piece >= 0)), *(taken - own for taken in later)]


def _without(whole: Body, others: list[Body]) -> Body:
    import manifold3d

    rest = manifold3d.Manifold.batch_boolean([whole, *others], manifold3d.OpType.Subtract)
    rest.num_tri()
    return rest


def _within(wall: Body, low: Floats, high: Floats) -> Body:
    import manifold3d

    return wall ^ manifold3d.Manifold.cube((high - low).tolist()).translate(low.tolist())


def _marks(solid: Solid) -> Floats:
    """Give points inside a piece's outer sheet, most of them away from its border."""
    outer = solid.F[solid.kind == OUTER]
    border = border_halfedges(outer)
    inside = np.zeros(len(solid.V), bool)
    inside[outer] = True
    inside[outer.ravel()[border]] = False
    points = solid.V[inside] if inside.any() else solid.V[outer].mean(axis=1)
    return np.asarray(points[:: max(1, len(points) // _MARKS)])


def _marked(rest: Body, marks: Floats) -> tuple[Body, list[Body]]:
    """Give the part with most marks on it, and others that have some."""
    import igl

    parts = [part for part in rest.decompose() if part.volume() > 0]
    if not parts:
        return rest, []
    on = [int((igl.point_mesh_squared_distance(marks, *arrays(part))[0] < _ON**2).sum()) for part in parts]
    main = int(np.argmax(on))
    return parts[main], [part for k, part in enumerate(parts) if on[k] and k != main]
