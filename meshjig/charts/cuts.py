"""Cuts along the edges of a mesh: opened, and followed from end to end."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.mesh.halfedges import Edges, next_halfedge
from meshjig.mesh.types import Bools, Ints

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
    corners = cut_faces(F, e, cut, np.arange(len(F)))
    origin = np.empty(int(corners.max(initial=-1)) + 1, np.int64)
    origin[corners] = F
    return corners, origin


def cut_faces(F: Ints, e: Edges, cut: Bools, faces: Ints) -> Ints:
    """Cut open some of the faces only.

    Parameters
    ----------
    F : (m, 3) int64, manifold, oriented; a vertex inside has one fan of faces
    e : Edges, of F
    cut : (e,) bool; all edges where the faces meet others are cut
    faces : (k,) int64

    Returns
    -------
    corners : (k, 3) int64, numbers of copies, 0 to n - 1; faces hang together over uncut edges
    """
    vertex, corner = F[faces].ravel(), (3 * faces[:, None] + np.arange(3)).ravel()
    whole = np.zeros(int(e.E.max(initial=-1)) + 1, bool)  # vertices that stay one
    whole[vertex] = True
    whole[e.E[cut].ravel()] = False
    begins = np.bincount(vertex[e.twin[corner] == corner], minlength=len(whole))
    whole &= begins <= 1  # where borders touch each other, several fans meet
    copy = (np.cumsum(whole) - 1)[vertex]
    split = np.flatnonzero(~whole[vertex])
    h = 3 * faces[split // 3] + split % 3
    number = np.empty(len(e.twin), np.int64)
    number[h] = np.arange(len(h))
    rows = np.flatnonzero((e.twin[h] != h) & ~cut[e.edge_of_halfedge[h]])
    cols = number[next_halfedge(e.twin[h[rows]])]
    graph = coo_matrix((np.ones(len(rows)), (rows, cols)), shape=(len(h), len(h)))
    _, part = connected_components(graph, directed=False)
    copy[split] = whole.sum() + part
    return _as_they_come(copy).reshape(-1, 3)


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
    vertex, E = _renumbered(E)
    stops = np.flatnonzero(np.isin(vertex, stops))
    n = len(vertex)
    degree = np.bincount(E.ravel(), minlength=n)
    node = degree != 2
    node[stops] = True
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


def _renumbered(E: Ints) -> tuple[Ints, Ints]:
    """Give the vertices that edges have, in order, and the edges with these numbered from 0."""
    vertex, number = np.unique(E, return_inverse=True)
    return vertex, number.reshape(E.shape)


def _as_they_come(number: Ints) -> Ints:
    """Number things (k,) anew in the order in which they first come: neighbours stay near in memory."""
    first, place = np.empty(int(number.max(initial=-1)) + 1, np.int64), np.arange(len(number))
    first[number[::-1]] = place[::-1]
    first = first[number]
    return (np.cumsum(first == place) - 1)[first]
