"""Carry charts from a light proxy over to the full mesh."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.clean_labels import tidy
from meshjig.charts.segment.diffuse_labels import diffusion
from meshjig.charts.segment.dual_graph import Dual, dual
from meshjig.mesh.closest_points import Nearest, nearest
from meshjig.mesh.halfedges import Edges, edges, next_halfedge
from meshjig.mesh.measure import area_vectors

__all__ = ["transfer_labels", "transfer_uv"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_REACHES = (0.02, 0.005, 0.0)  # of the root of the area: a proxy's faces show as teeth along its borders
_FOLD = 0.75  # cosine between normals; over sharper edges shares are not averaged
_SURE = 0.999  # the share from which a label has no rival
_LONG = 2.0  # times that reach: sides of faces so large that their borders are straight already
_AT_ONCE = 2_000_000  # numbers to hold in memory


def transfer_labels(
    V: Floats,
    F: Ints,
    W: Floats,
    G: Ints,
    label: Ints,
    e: Edges | None = None,
    places: Nearest | None = None,
) -> Ints:
    """Give each face of a mesh the label that its place on a proxy has, with borders made straight.

    On the proxy, labels diffuse into shares; they are interpolated like colours, so that borders of
    the mesh cut smoothly through the faces of the proxy. Folds hold them in place.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh, one component
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy
    label : (m',) int64, 0 to k - 1
    e : Edges, of F, where the caller has them
    places : Nearest, of all V, where the caller has them

    Returns
    -------
    label : (m,) int64. A label may come out empty, or as no disc: the caller checks.
    """
    twin = (edges(F) if e is None else e).twin
    places = nearest(V, W, G) if places is None else places
    k = int(label.max()) + 1
    wanted = _euler_numbers(G, edges(G).twin, label, k)
    best, fewest = label, k + 1
    seen = _Seen(V, F, W, G, places)
    for reach in _REACHES:  # farther, strips get lost through which a label is a disc
        carried = tidy(F, seen.strongest(_shares(W, G, label, reach)), seen.area, twin)
        broken = int((_euler_numbers(F, twin, carried, k) != wanted).sum())
        if broken < fewest:
            best, fewest = carried, broken
        if not broken:
            break
    return best


def _euler_numbers(F: Ints, twin: Ints, label: Ints, k: int) -> Ints:
    """Give the Euler number of each label's faces, (k,)."""
    touches = np.zeros((int(F.max()) + 1, k), bool)
    touches[F, label[:, None]] = True
    own = np.repeat(label, 3)
    inner = own[(twin > np.arange(len(twin))) & (own == label[twin // 3])]
    corners = touches.sum(0)
    return corners - 2 * np.bincount(label, minlength=k) + np.bincount(inner, minlength=k)


class _Seen:
    """A proxy as the faces of a mesh see it."""

    def __init__(self, V: Floats, F: Ints, W: Floats, G: Ints, places: Nearest) -> None:
        self._V, self._F, self._W, self._G, self._at = V, F, W, G, places.face
        self._N, self._M = area_vectors(V, F), area_vectors(W, G)
        self.area = np.linalg.norm(self._N, axis=1)
        self._alike = np.zeros(len(F))  # above 0 where the proxy is seen from the same side
        for own, normal in zip(self._N.T, self._M.T, strict=True):
            at = normal[places.face]
            self._alike += own * (at.take(F[:, 0]) + at.take(F[:, 1]) + at.take(F[:, 2]))

    def strongest(self, share: Floats) -> Ints:
        """Give each face the label with most share where it is nearest, -1 on the back of a thin sheet."""
        best = share.argmax(2)
        sure = (share.max(2) > _SURE).all(1) & (best == best[:, :1]).all(1)
        clear = np.where(sure, best[:, 0], -1)[self._at]
        a, b, c = (clear.take(corner) for corner in self._F.T)
        known = np.where((a == b) & (b == c), a, -1)
        rivals = np.flatnonzero(known < 0)
        centre, bary = nearest(self._V[self._F[rivals]].mean(1), self._W, self._G)
        known[rivals] = _strongest(share, centre, np.clip(bary, 0, 1))
        alike = self._alike.copy()
        alike[rivals] = np.einsum("ij,ij->i", self._N[rivals], self._M[centre])
        if alike.max() >= 0:
            known[alike < 0] = -1
        return known


def _shares(W: Floats, G: Ints, label: Ints, reach: float) -> Floats:
    """Give the share of every label at every corner of the proxy's faces, (m', 3, k)."""
    own = np.eye(int(label.max()) + 1)[label]
    if not reach:
        return np.repeat(own[:, None], 3, 1)
    graph = dual(W, G)
    share = diffusion(graph, reach)(label)
    inside, thin = _inside_and_thin(G, label)
    share[inside] = own[inside]
    share = _corner_shares(graph, G, share)
    side = np.linalg.norm(W[G] - W[np.roll(G, -1, 1)], axis=2).max(1)
    hard = thin | (side > _LONG * reach * np.sqrt(graph.area.sum()))
    share[hard] = own[hard][:, None]
    return share


def _inside_and_thin(G: Ints, label: Ints) -> tuple[Bools, Bools]:
    """Mark faces that touch no other label, and those at strips that smoothing would wear away."""
    n = int(G.max()) + 1
    low, high = np.full(n, len(label)), np.full(n, -1)
    np.minimum.at(low, G.ravel(), np.repeat(label, 3))
    np.maximum.at(high, G.ravel(), np.repeat(label, 3))
    inner = low == high
    core = inner[G].any(1)
    k = int(label.max()) + 1
    near_core = np.isin(G * k + label[:, None], np.unique(G[core] * k + label[core][:, None])).any(1)
    at_strip = np.zeros(n, bool)
    at_strip[G[~near_core].ravel()] = True
    return np.all(inner[G], axis=1), np.any(at_strip[G], axis=1)


def _corner_shares(graph: Dual, G: Ints, share: Floats) -> Floats:
    """Average the shares of faces around their corners, not over folds; (m', 3, k)."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    flat = graph.bend > _FOLD
    a, b = graph.halfedge[flat], graph.twin[flat]
    rows = np.concatenate([a, next_halfedge(a)])
    cols = np.concatenate([next_halfedge(b), b])
    join = coo_matrix((np.ones(len(rows), np.int8), (rows, cols)), shape=(G.size, G.size))
    n, fan = connected_components(join, directed=False)
    weight = np.repeat(np.maximum(graph.area, 1e-9 * graph.area.mean()), 3)
    total = np.bincount(fan, weight, n)
    spread = coo_matrix((weight / total[fan], (fan, np.arange(G.size) // 3)), shape=(n, len(G))).tocsr()
    return np.asarray(spread @ share)[fan.reshape(-1, 3)]


def _strongest(share: Floats, face: Ints, bary: Floats) -> Ints:
    """Give the label with most share at points of faces, of whose corners share (m', 3, k) tells."""
    out = np.empty(len(face), np.int64)
    step = max(1, _AT_ONCE // share[0].size)
    for start in range(0, len(face), step):
        some = slice(start, start + step)
        out[some] = np.einsum("fj,fjl->fl", bary[some], share[face[some]]).argmax(1)
    return out


def transfer_uv(V: Floats, W: Floats, G: Ints, uv: Floats) -> Floats:
    """Give points the place in the plane that their nearest point on a proxy chart has.

    Points beyond the border of the proxy chart follow the plane of its nearest face.

    Parameters
    ----------
    V : (n, 3) float64, mm
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy's chart
    uv : (n', 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm. Faces may come out mirrored: see untangle.
    """
    return nearest(V, W, G).interpolated(G, uv)
