"""Which label each part of the cut mesh has, and which parts are connected."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.inner_halfedges import Ring
from meshjig.cut.predicates import orient, vertex_left_of_segment
from meshjig.cut.snap import Graph
from meshjig.cut.trace import FaceSegments
from meshjig.cut.uv_mesh import UvMesh
from meshjig.mesh.arrays import connected
from meshjig.mesh.chains import Cycles
from meshjig.mesh.halfedges import edges
from meshjig.mesh.types import Bools, Ints

__all__ = ["Regions", "joined_over_seams", "label_at", "label_regions", "regions"]


class Regions(NamedTuple):
    """Faces, and parts of faces, that are connected."""

    n: int
    face: Ints  # (m,), the region of untouched faces, -1 for cut ones
    part: Ints  # (c,), the region of each part of the cut faces


def regions(uv_mesh: UvMesh, ring: Ring, parts: Cycles) -> Regions:
    """Join parts of faces over sides of the mesh; outlines and seams are walls."""
    m = len(uv_mesh.F)
    untouched = ring.row < 0
    one, other = uv_mesh.faces[:, 0], uv_mesh.faces[:, 1]
    inner = np.flatnonzero(other >= 0)
    both = inner[untouched[one[inner]] & untouched[other[inner]]]
    rows, cols = [one[both]], [other[both]]

    # ring half-edges on the same interval of the same side are neighbours
    half = 3 * ring.faces[ring.face] + ring.corner
    side = uv_mesh.side[half]
    part = m + parts.of_member[: len(half)]
    order = np.argsort(ring.interval, kind="stable")
    interval, its_side = ring.interval[order], side[order]
    twin = np.flatnonzero((interval[1:] == interval[:-1]) & (its_side[1:] == its_side[:-1]))
    rows.append(part[order[twin]])
    cols.append(part[order[twin + 1]])

    # and a side without nodes may have an untouched face beyond
    for beyond in (one[side], other[side]):
        plain = np.flatnonzero((beyond >= 0) & untouched[beyond])
        rows.append(part[plain])
        cols.append(beyond[plain])
    r, c = np.concatenate(rows), np.concatenate(cols)
    _, label = connected(m + len(parts.size), r, c)
    used = np.append(untouched, np.ones(len(parts.size), bool))
    present = np.zeros(int(label.max(initial=-1)) + 1, bool)
    present[label[used]] = True
    number = np.cumsum(present) - 1
    label = np.where(used, number[label], -1)
    return Regions(int(present.sum()), label[:m], label[m:])


def label_regions(
    graph: Graph, face_segments: FaceSegments, n_ring: int, parts: Cycles, of: Regions
) -> tuple[Ints, Bools, int]:
    """Label regions by the outlines that bound them.

    Returns
    -------
    label : (n,) int64
    known : (n,) bool, False where no outline bounds the region
    n_conflicts : int, parts with an outline that says otherwise
    """
    left, right = graph.left[face_segments.segment], graph.right[face_segments.segment]
    said = np.concatenate(
        [np.where(face_segments.mirrored, right, left), np.where(face_segments.mirrored, left, right)]
    )
    where = of.part[parts.of_member[n_ring:]]
    values, said = np.unique(said, return_inverse=True)
    key, count = np.unique(where * np.int64(max(len(values), 1)) + said, return_counts=True)
    region, value = key // max(len(values), 1), key % max(len(values), 1)
    order = np.lexsort((-value, count, region))
    label = np.zeros(of.n, np.int64)
    known = np.zeros(of.n, bool)
    label[region[order]] = values[value[order]]  # the last word, said most often, stays
    known[region] = True
    return label, known, int((values[said] != label[where]).sum()) if len(said) else 0


def joined_over_seams(F: Ints, label: Ints, region: Ints) -> Ints:
    """Join regions of one label that meet over a seam; faces without a label stay apart.

    Parameters
    ----------
    F : (m, 3) int64, the cut mesh
    label : (m,) int64
    region : (m,) int64, all of one label each

    Returns
    -------
    region : (m,) int64, 0 to r - 1
    """
    n = int(region.max(initial=-1)) + 1
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    here, there = h // 3, twin[h] // 3
    alike = (region[here] != region[there]) & (label[here] == label[there]) & (label[here] >= 0)
    return connected(n, region[here[alike]], region[there[alike]])[1][region]


def label_at(graph: Graph, q: Ints) -> int:
    """Give the label at a grid point q (2,): that of the outline next to its right, else that outside."""
    if not len(graph.segments):
        return 0
    a, b = graph.points[graph.segments[:, 0]], graph.points[graph.segments[:, 1]]
    spans = np.flatnonzero((a[:, 1] >= q[1]) != (b[:, 1] >= q[1]))
    A, B = a[spans], b[spans]
    Q = np.broadcast_to(q, A.shape)
    left = vertex_left_of_segment(orient(A, B, Q), A, B)
    rises = B[:, 1] > A[:, 1]
    right_of_q = np.flatnonzero(left == rises)
    if not len(right_of_q):
        return _label_outside(graph, a, b)
    s = spans[right_of_q]
    s = s[_nearest(a[s], b[s], int(q[1]))]
    return int(graph.left[s] if b[s, 1] > a[s, 1] else graph.right[s])


def _nearest(a: Ints, b: Ints, y: int) -> int:
    """Give the segment that a line at height y meets first from the left, exactly."""
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    x = a[:, 0] + (y - a[:, 1]) * (dx / dy)
    close = np.flatnonzero(x <= x.min() + 1)
    # the shift (eps, eps^2) raises segments: those leaning right come first where they meet
    keys = [
        (
            (int(a[i, 0]) << 140) + (((y - int(a[i, 1])) * int(dx[i])) << 140) // int(dy[i]),
            -((int(dx[i]) << 140) // int(dy[i])),
        )
        for i in close
    ]
    return int(close[min(range(len(keys)), key=keys.__getitem__)])


def _label_outside(graph: Graph, a: Ints, b: Ints) -> int:
    """Give the label outside all outlines: right of the segment that reaches farthest right."""
    slanted = np.flatnonzero(a[:, 1] != b[:, 1])
    far = slanted[np.argmax(np.maximum(a[slanted, 0], b[slanted, 0]))]
    y = (a[far, 1] + b[far, 1]) / 2
    spans = np.flatnonzero((a[:, 1] > y) != (b[:, 1] > y))
    A, B = a[spans], b[spans]
    s = spans[np.argmax(A[:, 0] + (y - A[:, 1]) * (B[:, 0] - A[:, 0]) / (B[:, 1] - A[:, 1]))]
    return int(graph.right[s] if b[s, 1] > a[s, 1] else graph.left[s])
