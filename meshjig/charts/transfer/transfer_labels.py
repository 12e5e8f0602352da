"""Transfer labels and maps from a proxy to the full mesh."""

import numpy as np

from meshjig.charts.segment.clean_labels import clean_labels, diffusion
from meshjig.charts.segment.dual_graph import DualGraph, dual_graph
from meshjig.charts.segment.region import inner_vertices
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.closest_points import Nearest, nearest
from meshjig.mesh.halfedges import next_halfedge
from meshjig.mesh.measure import area_vectors
from meshjig.mesh.mesh import Mesh

__all__ = ["transfer_labels", "transfer_uv"]


_REACHES = (0.02, 0.005, 0.0)  # of the root of the area: a proxy's faces show as teeth along its borders
_FOLD = 0.75  # cosine between normals; over sharper edges shares are not averaged
_SURE = 0.999  # the share from which a label has no rival
_LONG = 2.0  # times that reach: sides of faces so large that their borders are straight already
_AT_ONCE = 2_000_000  # numbers to hold in memory


def transfer_labels(mesh: Mesh, proxy: Mesh, label: Ints, places: Nearest | None = None) -> Ints:
    """Give each face of a mesh the label that its place on a proxy has, with borders made straight.

    On the proxy, labels diffuse into shares; they are interpolated like colours, so that borders of
    the mesh cut smoothly through the faces of the proxy. Folds hold them in place.

    Parameters
    ----------
    mesh : Mesh, one component
    proxy : Mesh
    label : (m',) int64, 0 to k - 1, of the proxy's faces
    places : Nearest, of all vertices of the mesh, where the caller has them

    Returns
    -------
    label : (m,) int64. A label may come out empty, or as no disc: the caller checks.
    """
    places = nearest(mesh.V, proxy.V, proxy.F) if places is None else places
    k = int(label.max()) + 1
    wanted = _euler_numbers(proxy, label, k)
    best, fewest = label, k + 1
    seen = _Seen(mesh, proxy, places)
    for reach in _REACHES:  # farther, strips get lost through which a label is a disc
        transferred = clean_labels(mesh, seen.strongest(_shares(proxy.V, proxy.F, label, reach)), seen.area)
        broken = int((_euler_numbers(mesh, transferred, k) != wanted).sum())
        if broken < fewest:
            best, fewest = transferred, broken
        if not broken:
            break
    return best


def _euler_numbers(mesh: Mesh, label: Ints, k: int) -> Ints:
    """The Euler number of each label's faces, (k,)."""
    F, twin = mesh.F, mesh.edges.twin
    touches = np.zeros((int(F.max()) + 1, k), bool)
    touches[F, label[:, None]] = True
    own = np.repeat(label, 3)
    inner = own[(twin > np.arange(len(twin))) & (own == label[twin // 3])]
    corners = touches.sum(0)
    return corners - 2 * np.bincount(label, minlength=k) + np.bincount(inner, minlength=k)


class _Seen:
    """A proxy as the faces of a mesh see it."""

    def __init__(self, mesh: Mesh, proxy: Mesh, places: Nearest) -> None:
        self._V, self._F = V, F = mesh.V, mesh.F
        self._proxy, self._at = proxy, places.face
        self._N, self._M = area_vectors(V, F), proxy.area_vectors
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
        centre, bary = nearest(self._V[self._F[rivals]].mean(1), *self._proxy)
        known[rivals] = _strongest(share, centre, np.clip(bary, 0, 1))
        alike = self._alike.copy()
        alike[rivals] = np.einsum("ij,ij->i", self._N[rivals], self._M[centre])
        if alike.max() >= 0:
            known[alike < 0] = -1
        return known


def _shares(W: Floats, G: Ints, label: Ints, reach: float) -> Floats:
    """The share of every label at every corner of the proxy's faces, (m', 3, k)."""
    own = np.eye(int(label.max()) + 1)[label]
    if not reach:
        return np.repeat(own[:, None], 3, 1)
    graph = dual_graph(W, G)
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
    inner = inner_vertices(G, label)
    core = inner[G].any(1)
    k = int(label.max()) + 1
    near_core = np.isin(G * k + label[:, None], np.unique(G[core] * k + label[core][:, None])).any(1)
    at_strip = np.zeros(len(inner), bool)
    at_strip[G[~near_core].ravel()] = True
    return np.all(inner[G], axis=1), np.any(at_strip[G], axis=1)


def _corner_shares(graph: DualGraph, G: Ints, share: Floats) -> Floats:
    """Average the shares of faces around their corners, not over folds; (m', 3, k)."""
    from scipy.sparse import coo_matrix

    flat = graph.bend > _FOLD
    a, b = graph.halfedge[flat], graph.twin[flat]
    rows = np.concatenate([a, next_halfedge(a)])
    cols = np.concatenate([next_halfedge(b), b])
    n, fan = connected(G.size, rows, cols)
    weight = np.repeat(np.maximum(graph.area, 1e-9 * graph.area.mean()), 3)
    total = np.bincount(fan, weight, n)
    spread = coo_matrix((weight / total[fan], (fan, np.arange(G.size) // 3)), shape=(n, len(G))).tocsr()
    return np.asarray(spread @ share)[fan.reshape(-1, 3)]


def _strongest(share: Floats, face: Ints, bary: Floats) -> Ints:
    """The label with most share at points of faces, of whose corners share (m', 3, k) tells."""
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
