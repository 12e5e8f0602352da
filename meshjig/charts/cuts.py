"""Cuts along the edges of a mesh: opened, and followed from end to end."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.topology import Edges, next_halfedge
from meshjig.types import Bools, Ints

__all__ = ["chains", "cut_faces", "cut_open"]


def cut_open(F: Ints, e: Edges, cut: Bools) -> tuple[Ints, Ints]:
    """Give every vertex on a cut one copy for each side of the cut.

    Parameters
    ----------
    F : (m, 3) int64, manifold, oriented
    e : Edges, of F
    cut : (e,) bool

    Returns
    -------
    corners : (m, 3) int64, into the copies; faces are joined over uncut edges only
    origin : (n,) int64, the vertex of every copy
    """
    corners = cut_faces(e, cut, np.arange(len(F)))
    origin = np.empty(int(corners.max(initial=-1)) + 1, np.int64)
    origin[corners] = F
    return corners, origin


def cut_faces(e: Edges, cut: Bools, faces: Ints) -> Ints:
    """Cut open some of the faces only, in a time that does not depend on the others.

    Parameters
    ----------
    e : Edges, of a manifold, oriented mesh
    cut : (e,) bool; all edges where the faces meet others are cut
    faces : (k,) int64

    Returns
    -------
    corners : (k, 3) int64, numbers of copies, 0 to n - 1; faces hang together over uncut edges
    """
    corner = (3 * faces[:, None] + np.arange(3)).ravel()
    number = np.full(len(e.twin), -1)
    number[corner] = np.arange(len(corner))
    h = corner[(e.twin[corner] > corner) & ~cut[e.edge_of_halfedge[corner]]]
    t = e.twin[h]
    rows, cols = number[np.append(h, next_halfedge(h))], number[np.append(next_halfedge(t), t)]
    graph = coo_matrix((np.ones(len(rows), np.int8), (rows, cols)), shape=(len(corner), len(corner)))
    _, copy = connected_components(graph, directed=False)
    return copy.reshape(-1, 3).astype(np.int64)


def chains(E: Ints, stops: Ints) -> list[Ints]:
    """Follow edges from one vertex where they end, branch or are stopped to the next.

    Parameters
    ----------
    E : (k, 2) int64, vertices
    stops : (s,) int64, vertices where chains end though they would go on

    Returns
    -------
    list of int64 arrays, rows of E in order along the chain; a loop starts anywhere
    """
    n = int(E.max(initial=-1)) + 1
    degree = np.bincount(E.ravel(), minlength=n)
    node = degree != 2
    node[stops[stops < n]] = True
    order = np.argsort(E.ravel(), kind="stable")
    start = np.append(0, np.cumsum(degree)).tolist()
    at_vertex, ends, is_node = (order // 2).tolist(), E.tolist(), node.tolist()
    done = [False] * len(ends)

    def walk(row: int, vertex: int) -> list[int]:
        chain = []
        while not done[row]:
            done[row] = True
            chain.append(row)
            vertex = ends[row][1] if ends[row][0] == vertex else ends[row][0]
            if is_node[vertex]:
                break
            first, second = at_vertex[start[vertex] : start[vertex + 1]]
            row = second if first == row else first
        return chain

    found = [
        walk(at_vertex[i], v) for v in np.flatnonzero(node).tolist() for i in range(start[v], start[v + 1])
    ]
    found += [walk(row, ends[row][0]) for row in range(len(ends))]
    return [np.array(chain, np.int64) for chain in found if chain]
