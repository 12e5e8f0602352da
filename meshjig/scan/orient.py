"""Make faces agree on their side, and closed surfaces face outward."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.halfedges import edges
from meshjig.mesh.mesh import Mesh

__all__ = ["Sides", "make_coherent", "turn_outward"]

_CLEAR = 0.05  # volume / area^1.5 above which an open surface has an inside: a half sphere has 0.13


class Sides(NamedTuple):
    """A mesh whose closed components all face outward."""

    F: Ints  # (m, 3)
    turned: int  # components that were inside out
    cavity: Bools  # (m,), faces of shells that lie inside a solid; they face into their hollow


def make_coherent(F: Ints, *, strict: bool = True) -> tuple[Ints, int]:
    """Turn as few faces as possible so that neighbours agree.

    Parameters
    ----------
    F : (m, 3) int64
    strict : bool, whether a surface with one side only is an error; else it stays as it is

    Returns
    -------
    F : (m, 3) int64
    n_turned : int

    Raises
    ------
    InputError
        A component can't be oriented.

    Notes
    -----
    Each face stands twice in a graph, as it is and turned, and is linked to its neighbours' copies that
    agree with it. A component is orientable when its two copies are not connected.
    """
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    t = twin[h]
    agree = F.ravel()[h] != F.ravel()[t]
    if agree.all():
        return F, 0
    m = len(F)
    f, g = h // 3, t // 3
    rows = np.concatenate([f, f + m])
    cols = np.concatenate([np.where(agree, g, g + m), np.where(agree, g + m, g)])
    n, label = connected(2 * m, rows, cols)
    label = label.reshape(2, m)
    one_sided = label[0] == label[1]
    if strict and one_sided.any():
        raise InputError(
            f"the surface is non-orientable: like a Moebius band, {int(one_sided.sum())} of its {m} faces"
            " belong to a part with one side only",
            hint="cut the band apart, or remove the part",
            ids=np.flatnonzero(one_sided)[:100].tolist(),
        )
    # of the two copies of a component, keep the one that holds more of the faces as they are
    as_is = np.bincount(label[0], minlength=n)
    a, b = as_is[label[0]], as_is[label[1]]
    turn = ~one_sided & ((a < b) | ((a == b) & (label[0] > label[1])))
    F = F.copy()
    F[turn] = F[turn][:, ::-1]
    return F, int(turn.sum())


def turn_outward(mesh: Mesh) -> Sides:
    """Turn inside-out components, and find the shells that are hollows of a solid.

    A closed component inside an odd number of others bounds a hollow, whichever way it faces; it is made
    to face into it. An open component is turned only when it clearly bulges the wrong way.

    Parameters
    ----------
    mesh : Mesh, manifold and coherent

    Returns
    -------
    Sides
    """
    V, F = mesh
    n, component = mesh.n_components, mesh.component_of_face
    open_ = np.bincount(component[mesh.borders // 3], minlength=n) > 0
    depth = _depth(V, F, n, component, open_)
    volume = _volumes(mesh, open_)
    area = np.bincount(component, mesh.areas, n)
    hollow = depth % 2 == 1
    unclear = open_ & (np.abs(volume) < _CLEAR * area**1.5)
    turn = ((volume < 0) != hollow) & ~unclear & (volume != 0)
    if turn.any():
        F = F.copy()
        faces = turn[component]
        F[faces] = F[faces][:, ::-1]
    return Sides(F, int(turn.sum()), hollow[component])


def _volumes(mesh: Mesh, open_: Bools) -> Floats:
    """Each component's signed volume; an open one is measured from the middle of its border."""
    V, F = mesh
    n, component, h = mesh.n_components, mesh.component_of_face, mesh.borders
    # closed: any origin does, one nearby is exact; open: cones over the border's middle close it
    weight = np.bincount(component, minlength=n).astype(float) * ~open_
    weight += np.bincount(component[h // 3], minlength=n)
    closed = ~open_[component]
    which = np.concatenate([component[h // 3], component[closed]])
    points = np.concatenate([V[F.ravel()[h]], V[F[closed, 0]]])
    origin = np.stack([np.bincount(which, points[:, k], n) for k in range(3)], 1) / weight[:, None]
    cone = np.einsum("ij,ij->i", V[F[:, 0]] - origin[component], mesh.area_vectors) / 6
    return np.bincount(component, cone, n).astype(np.float64)


def _depth(V: Floats, F: Ints, n: int, component: Ints, open_: Bools) -> Ints:
    """Count the closed components around each closed component."""
    depth = np.zeros(n, np.int64)
    if n == 1:
        return depth
    order = np.argsort(component, kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(component, minlength=n))[:-1])
    low = np.stack([V[F[part]].min(axis=(0, 1)) for part in parts])
    high = np.stack([V[F[part]].max(axis=(0, 1)) for part in parts])
    for outer in np.flatnonzero(~open_):
        inner = np.flatnonzero(~open_ & (low > low[outer]).all(axis=1) & (high < high[outer]).all(axis=1))
        for k in inner:
            corners = np.unique(F[parts[k]])
            samples = V[corners[np.linspace(0, len(corners) - 1, 7).astype(int)]]
            depth[k] += bool((np.abs(_winding(samples, V[F[parts[outer]]])) > 0.9).all())
    return depth


def _winding(points: Floats, triangles: Floats) -> Floats:
    """The winding number of triangles (m, 3, 3) around each point.

    References
    ----------
    van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983.
    """
    out = np.empty(len(points))
    for i, point in enumerate(points):
        a, b, c = (triangles - point).transpose(1, 0, 2)
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
        det = np.einsum("ij,ij->i", a, np.cross(b, c))
        out[i] = np.arctan2(det, la * lb * lc + ab * lc + bc * la + ca * lb).sum() / (2 * np.pi)
    return out
