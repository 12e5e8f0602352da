"""A surface with all that is measured on it once, for cells to grow on."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.mesh.arrays import connected
from meshjig.mesh.halfedges import Edges, next_halfedge
from meshjig.mesh.measure import sums, unit
from meshjig.mesh.types import Bools, Floats, Ints, Mesh

__all__ = ["Surface", "surface", "surface_graph", "turns"]


_WEIGHTS = (1e-3, 1e3)  # bounds: slivers neither tear nor rule
_SHARP_EDGES = 6  # at a vertex, at most
_STRAIGHT = -np.cos(np.radians(40))  # between two edges of a crease: less is nearly straight on
_GENTLE = np.radians(8)  # a turn from one vertex to the next that is no crease
_SHARP = np.cos(np.radians(40))  # between the normals of two faces: less is a crease


@dataclass(frozen=True)
class Surface:
    """A mesh, its edges, areas, distances and components."""

    mesh: Mesh
    area: Floats  # (n,), mm2, of each vertex
    graph: Any  # from surface_graph
    weight: Any  # (n, n) sparse, of each edge: the mean of its cotangents
    steep: Bools  # (n,), on a crease that borders should follow
    component: Ints  # (n,)
    component_area: Floats  # (c,), mm2
    closed: Bools  # (c,)

    @property
    def V(self) -> Floats:
        """The vertices, (n, 3), mm."""
        return self.mesh.V

    @property
    def F(self) -> Ints:
        """The faces, (m, 3)."""
        return self.mesh.F

    @property
    def e(self) -> Edges:
        """The edges."""
        return self.mesh.edges

    def targets(self, seeds: Ints, relative: Floats) -> Floats:
        """Share each component's area among its seeds, in proportion to relative areas; (N,), mm2."""
        group = self.component[seeds]
        total = sums(group, relative, len(self.component_area))
        scaled: Floats = relative * (self.component_area / np.maximum(total, 1e-300))[group]
        return scaled


def surface(mesh: Mesh, bend: float = 0.0) -> Surface:
    """Measure a mesh without unused vertices; bend as in surface_graph."""
    V, F, e = mesh.V, mesh.F, mesh.edges
    area = sums(F.ravel(), np.repeat(mesh.areas / 3, 3), len(V))
    k, component = connected(len(V), *e.E.T)
    closed = ~np.isin(np.arange(k), component[e.E[e.n_faces == 1]])
    steep = _steep(mesh) if bend else np.zeros(len(V), bool)
    return Surface(
        mesh,
        area,
        surface_graph(mesh, bend),
        _cotangents(mesh),
        steep,
        component,
        sums(component, area, k),
        closed,
    )


def surface_graph(mesh: Mesh, bend: float = 0.0) -> Any:
    """Join vertices by the edges of a mesh and, straight across each edge, the two corners opposite it.

    Shortest paths over this graph are within a few per cent of the geodesic distance.

    Parameters
    ----------
    mesh : Mesh
    bend : float, mm
        What a radian costs that the surface turns by on a path; gentle turns cost nothing.

    Returns
    -------
    scipy.sparse.csr_matrix, (n, n), symmetric, mm
    """
    from scipy.sparse import csr_matrix

    V, F, e = mesh.V, mesh.F, mesh.edges
    h = mesh.inner_halfedges
    ends = e.E[e.edge_of_halfedge[h]]
    opposite = np.stack([_opposite(F, h), _opposite(F, e.twin[h])], 1)
    length, straight = _unfolded(V, ends, opposite)
    pairs = np.concatenate([e.E, opposite[straight]])
    far = np.concatenate([np.linalg.norm(V[e.E[:, 0]] - V[e.E[:, 1]], axis=1), length[straight]])
    if bend:
        far = far + bend * turns(mesh, pairs)
    key = pairs.min(1) * len(V) + pairs.max(1)
    order = np.lexsort((far, key))
    first = np.ones(len(key), bool)  # of two paths between the same vertices, the shorter
    first[1:] = np.diff(key[order]) > 0
    a, b = pairs[order[first]].T
    far = np.maximum(far[order[first]], 1e-9)  # an entry of 0 would be no edge
    return csr_matrix((np.tile(far, 2), (np.r_[a, b], np.r_[b, a])), shape=(len(V), len(V)))


def turns(mesh: Mesh, pairs: Ints) -> Floats:
    """Give by how much the surface turns from one vertex to another, (k,), radians; gentle turns are 0."""
    N = mesh.vertex_normals
    angle = np.arccos(np.clip(np.einsum("ij,ij->i", N[pairs[:, 0]], N[pairs[:, 1]]), -1, 1))
    return np.maximum(angle - _GENTLE, 0.0)


def _cotangents(mesh: Mesh) -> Any:
    """Give the weights of edges that make averages over neighbours keep linear functions, (n, n)."""
    from scipy.sparse import csr_matrix

    V, F, e = mesh.V, mesh.F, mesh.edges
    cotangent = np.empty(3 * len(F))
    for k in range(3):
        opposite = V[F[:, k - 1]]
        p, q = V[F[:, k]] - opposite, V[F[:, (k + 1) % 3]] - opposite
        area = np.linalg.norm(np.cross(p, q), axis=1)
        cotangent[k::3] = np.einsum("ij,ij->i", p, q) / np.maximum(area, 1e-300)
    w = np.clip(sums(e.edge_of_halfedge, cotangent, len(e.E)) / 2, *_WEIGHTS)
    a, b = e.E.T
    return csr_matrix((np.r_[w, w], (np.r_[a, b], np.r_[b, a])), shape=(len(V), len(V)))


def _steep(mesh: Mesh) -> Bools:
    """Mark the vertices at which a crease goes straight on, (n,)."""
    V, e = mesh.V, mesh.edges
    normal = unit(mesh.area_vectors)
    h = mesh.inner_halfedges
    sharp = np.einsum("ij,ij->i", normal[h // 3], normal[e.twin[h] // 3]) < _SHARP
    ends = e.E[e.edge_of_halfedge[h[sharp]]]
    both = np.concatenate([ends, ends[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    direction = unit(V[both[:, 1]] - V[both[:, 0]])
    out = np.zeros(len(V), bool)
    for k in range(1, _SHARP_EDGES):  # edges k places apart in the list of those at a vertex
        at = both[k:, 0] == both[:-k, 0]
        on = np.einsum("ij,ij->i", direction[k:], direction[:-k]) < _STRAIGHT
        out[both[k:, 0][at & on]] = True
    return out


def _opposite(F: Ints, h: Ints) -> Ints:
    return F.ravel()[next_halfedge(next_halfedge(h))]


def _unfolded(V: Floats, ends: Ints, opposite: Ints) -> tuple[Floats, Bools]:
    """Lay both faces of edges flat: how far apart their far corners are, and whether the edge is between."""
    start = V[ends[:, 0]]
    along = V[ends[:, 1]] - start
    length = np.maximum(np.linalg.norm(along, axis=1), 1e-300)
    x, y = np.empty((2, len(ends))), np.empty((2, len(ends)))
    for k in range(2):
        p = V[opposite[:, k]] - start
        x[k] = np.einsum("ij,ij->i", p, along) / length
        y[k] = np.sqrt(np.maximum(np.einsum("ij,ij->i", p, p) - x[k] ** 2, 0.0))
    across = x[0] + (x[1] - x[0]) * y[0] / np.maximum(y[0] + y[1], 1e-300)
    return np.hypot(x[1] - x[0], y[0] + y[1]), (across > 0) & (across < length)
