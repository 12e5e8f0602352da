"""Carry charts from a light proxy over to the full mesh."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.dual import Dual, dual
from meshjig.charts.smooth import diffusion
from meshjig.charts.tidy import tidy
from meshjig.measure import area_vectors, barycentric, interpolate
from meshjig.topology import Edges, edges, next_halfedge

__all__ = ["transfer_labels", "transfer_uv"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_REACHES = (0.02, 0.005, 0.0)  # of the root of the area: a proxy's faces show as teeth along its borders
_FOLD = 0.75  # cosine between normals; over sharper edges shares are not averaged
_SURE = 0.999  # the share from which a label has no rival
_LONG = 2.0  # times that reach: sides of faces so large that their borders are straight already
_BEYOND = 20.0  # barycentric coordinate: how far beyond a face its plane is followed
_AT_ONCE = 2_000_000  # numbers to hold in memory


def transfer_labels(V: Floats, F: Ints, W: Floats, G: Ints, label: Ints, e: Edges | None = None) -> Ints:
    """Give each face of a mesh the label that its place on a proxy has, with borders made straight.

    On the proxy, labels diffuse into shares; they are interpolated like colours, so that borders of
    the mesh cut smoothly through the faces of the proxy. Folds hold them in place.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh, one component
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy
    label : (m',) int64, 0 to k - 1
    e : Edges, of F, where the caller has them

    Returns
    -------
    label : (m,) int64. A label may come out empty, or as no disc: the caller checks.
    """
    twin = (edges(F) if e is None else e).twin
    k = int(label.max()) + 1
    wanted = _euler_numbers(G, edges(G).twin, label, k)
    best, fewest = label, k + 1
    for reach in _REACHES:  # farther, strips get lost through which a label is a disc
        carried = _carried(V, F, twin, W, G, _shares(W, G, label, reach))
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
    h = np.arange(len(twin))
    inner = label[h // 3][(twin > h) & (label[h // 3] == label[twin // 3])]
    corners = touches.sum(0)
    return corners - 2 * np.bincount(label, minlength=k) + np.bincount(inner, minlength=k)


def _carried(V: Floats, F: Ints, twin: Ints, W: Floats, G: Ints, share: Floats) -> Ints:
    """Give each face the label with most share where it is nearest to the proxy."""
    best = share.argmax(2)
    sure = (share.max(2) > _SURE).all(1) & (best == best[:, :1]).all(1)
    clear = np.where(sure, best[:, 0], -1)
    near, _ = _nearest(V, W, G)
    of_corner = clear[near][F]
    known = np.where((of_corner == of_corner[:, :1]).all(1), of_corner[:, 0], -1)
    N, M = area_vectors(V, F), area_vectors(W, G)
    rivals = np.flatnonzero(known < 0)
    centre, bary = _nearest(V[F[rivals]].mean(1), W, G)
    known[rivals] = _strongest(share, centre, np.clip(bary, 0, 1))
    seen = M[near][F].sum(1)
    seen[rivals] = M[centre]
    same_side = np.einsum("ij,ij->i", N, seen) >= 0  # of a thin sheet
    if same_side.any():
        known[~same_side] = -1
    return tidy(F, known, np.linalg.norm(N, axis=1), twin)


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


def _nearest(points: Floats, W: Floats, G: Ints) -> tuple[Ints, Floats]:
    """Give the face of a mesh that is nearest to each point, and the place in its plane."""
    import igl

    _, face, _ = igl.point_mesh_squared_distance(points, W, G)
    return face, barycentric(W, G, face, points)


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
    face, bary = _nearest(V, W, G)
    bary = np.clip(bary, -_BEYOND, _BEYOND)
    bary[:, 0] = 1 - bary[:, 1] - bary[:, 2]
    return interpolate(uv, G, face, bary)
