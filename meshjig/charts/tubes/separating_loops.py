"""Cut a tube along paths of edges: open from end to end, and apart by short loops around it."""

from typing import Any

import numpy as np

from meshjig.charts.tubes.harmonic_function import Ends
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, compact, edges, next_halfedge
from meshjig.mesh.shortest_paths import edge_graph, shortest_way

__all__ = ["across", "avoiding", "border_vertices", "divided", "halfedges_along", "left_corners"]

_REACH = 1.5  # mean edges that a loop may leave its cut on either side
_TRIES = 5  # each with twice the reach


def across(V: Floats, F: Ints, ends: Ends) -> Bools:
    """Mark the corners on the left of a short line from the first end to the last, (m, 3)."""
    graph = edge_graph(V, F)
    graph = avoiding(graph, np.setdiff1d(border_vertices(F), np.append(ends.first, ends.last)))
    return left_corners(F, shortest_way(graph, ends.first, ends.last))


def divided(V: Floats, F: Ints, ends: Ends, left: Bools, along: Floats, cuts: Floats) -> Ints:
    """Label faces by the loops below them.

    Each loop is the shortest around the tube that stays near its cut, so that the borders
    between labels are as straight as the edges allow.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, a tube
    ends : Ends; no loop touches them, nor holes
    left : (m, 3) bool, see `across`
    along : (n,) float64, mm along the tube
    cuts : (k,) float64, mm along the tube, increasing

    Returns
    -------
    label : (m,) int64, 0 to k

    Raises
    ------
    ChartError
        No loop can be found at a cut, or two loops meet.
    """
    turn = _turns(F, left)
    reach = _REACH * _edge(V, F)
    barred = np.concatenate([ends.first, ends.last, border_vertices(F)])
    wall = np.zeros(F.size, bool)
    for cut in cuts.tolist():
        off = np.abs(along - cut) / reach
        off[barred] = np.inf
        wall[halfedges_along(F, _loop(V, F, turn, off))] = True
    n, part = components(F, wall)
    middle = along[F].mean(1)
    mean = np.bincount(part, middle, n) / np.bincount(part, minlength=n)
    if n != len(cuts) + 1:
        raise ChartError(
            f"the tube falls into {n} parts where {len(cuts) + 1} rings were wanted", hint="use --charts auto"
        )
    return np.argsort(np.argsort(mean))[part].astype(np.int64)


def _turns(F: Ints, left: Bools) -> Ints:
    """Give for each half-edge, (3 m,), how often it crosses the line from right to left: -1, 0 or 1.

    Crossing it that way, one comes to the end of a period.
    """
    here = left.astype(np.int64)
    jump: Ints = (np.roll(here, -1, 1) - here).ravel()
    return jump


def border_vertices(F: Ints) -> Ints:
    """List the vertices on borders."""
    h = border_halfedges(F)
    return np.unique(np.append(F.ravel()[h], F.ravel()[next_halfedge(h)]))


def avoiding(graph: Any, vertices: Ints) -> Any:
    """Make all edges at some vertices so long that no path goes there that can go elsewhere."""
    from scipy.sparse import diags

    far = np.ones(graph.shape[0])
    far[vertices] = 1e3
    return diags(far) @ graph @ diags(far)


def _loop(V: Floats, F: Ints, turn: Ints, off: Floats) -> Ints:
    """The shortest loop around a tube among vertices that are little off, (n,), its cut.

    It repeats its first vertex.
    """
    for k in range(_TRIES):
        faces = np.flatnonzero((off <= 2.0**k)[F].all(1))
        if not len(faces):
            continue
        G, kept = compact(F[faces])
        graph = _two_sheets(V[kept], G, turn.reshape(-1, 3)[faces].ravel(), 1 + off[kept] ** 2)
        path = _once_around(graph, int(np.argmin(off[kept])))
        if len(path):  # once more from the far side: a poor start would stay a spike
            path = _once_around(graph, int(path[len(path) // 2]))
        if len(path) and len(np.unique(path)) == len(path) - 1:
            return kept[path]
    x, y, z = V[np.argmin(off)]
    raise ChartError(
        f"no loop goes around the surface near ({x:.0f}, {y:.0f}, {z:.0f}) mm", hint="use --charts auto"
    )


def _two_sheets(V: Floats, F: Ints, turn: Ints, toll: Floats) -> Any:
    """The graph of edges over two copies of a mesh, joined over the line; (2 n, 2 n).

    An edge counts for its length times the mean toll (n,) at its ends.
    """
    from scipy.sparse import csr_matrix

    n = len(V)
    a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
    a, b, turn = np.append(a, b), np.append(b, a), np.append(turn, -turn)  # borders have one half-edge
    plain, up, down = turn == 0, turn > 0, turn < 0
    rows = np.concatenate([a[plain], a[plain] + n, a[up], a[down] + n])
    cols = np.concatenate([b[plain], b[plain] + n, b[up] + n, b[down]])
    key = np.unique(rows * np.int64(2 * n) + cols)
    rows, cols = key // (2 * n), key % (2 * n)
    length = np.linalg.norm(V[rows % n] - V[cols % n], axis=1)
    length *= (toll[rows % n] + toll[cols % n]) / 2
    return csr_matrix((length, (rows, cols)), shape=(2 * n, 2 * n))


def _once_around(graph: Any, start: int) -> Ints:
    n = graph.shape[0] // 2
    return shortest_way(graph, np.array([start]), np.array([start + n])) % n


def _edge(V: Floats, F: Ints) -> float:
    return float(np.linalg.norm(V[F] - V[np.roll(F, -1, 1)], axis=2).mean())


def halfedges_along(F: Ints, path: Ints) -> Ints:
    """List the half-edges that run along a path of vertices, in its direction and against it."""
    n = np.int64(int(F.max()) + 1)
    a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
    steps = np.concatenate([path[:-1] * n + path[1:], path[1:] * n + path[:-1]])
    return np.flatnonzero(np.isin(a * n + b, steps))


def left_corners(F: Ints, path: Ints) -> Bools:
    """Mark the corners that lie on the left of a path.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    path : (k,) int64, vertices, each once; at its ends it reaches the border, and nowhere else. An
        end inside the mesh has nothing on its left.

    Returns
    -------
    (m, 3) bool
    """
    on_path = np.zeros(int(F.max()) + 1, bool)
    on_path[path] = True
    touching = np.flatnonzero(on_path[F].any(1))
    G = F[touching]
    twin = edges(G).twin
    along = halfedges_along(G, path)
    h = np.flatnonzero(twin > np.arange(len(twin)))
    h = np.setdiff1d(h, along)
    t = twin[h]
    rows, cols = np.append(h, next_halfedge(h)), np.append(next_halfedge(t), t)
    n, fan = connected(G.size, rows, cols)
    place = np.full(len(on_path), -1)
    place[path] = np.arange(len(path))
    tail, head = place[G.ravel()[along]], place[G.ravel()[next_halfedge(along)]]
    forth = head == tail + 1
    is_left, is_right = np.zeros(n, bool), np.zeros(n, bool)
    for side, some in ((is_left, along[forth]), (is_right, along[~forth])):
        side[fan[some]] = side[fan[next_halfedge(some)]] = True
    left = np.zeros(F.shape, bool)
    left[touching] = (is_left & ~is_right)[fan].reshape(-1, 3) & on_path[G]
    return left
