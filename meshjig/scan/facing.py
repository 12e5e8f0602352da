"""Turn the open sheets of a model to the side from which they are seen."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, face_areas, interpolate, unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["turn_by_sight"]

_RAYS = 4000  # from either side of a sheet
_SKIN = 1e-4  # of the extent: rays start this far before a face, in the float32 of Embree


def turn_by_sight(V: Floats, F: Ints) -> Ints:
    """Turn open components so that they face where more of the outside can be seen.

    The sheets of a model made of many face any way. From points spread evenly over a sheet, rays go to
    both sides: the one where more of them leave the model, or, where none does, where they get farther,
    is the front. Closed components stay.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold and coherent

    Returns
    -------
    F : (m, 3) int64

    References
    ----------
    Takayama, Jacobson, Kavan and Sorkine-Hornung, "A Simple Method for Correcting Facet Orientations in
    Polygon Meshes Based on Ray Casting", 2014.
    """
    mesh = Mesh(V, F)
    component = mesh.component_of_face
    sheets = np.unique(component[mesh.borders // 3])
    if not len(sheets):
        return F
    scene = RayScene(V, F, robust=False)
    extent = float(np.ptp(V, axis=0).max())
    turned = np.zeros(mesh.n_components, bool)
    for sheet in sheets:
        P, N, ray = _rays(V, F[component == sheet])
        seen = []
        for side in (1, -1):
            hit = scene.hits(P + side * _SKIN * extent * N, side * ray)
            out = hit["primID"] < 0
            seen.append((out.sum(), hit["tfar"][~out].sum()))
        turned[sheet] = seen[1] > seen[0]
    F = F.copy()
    F[turned[component]] = F[turned[component]][:, ::-1]
    return F


def _rays(V: Floats, F: Ints) -> tuple[Floats, Floats, Floats]:
    """Spread points over faces; give them, their normals, and directions spread about the normals."""
    k = np.arange(1, _RAYS + 1)
    end = np.cumsum(face_areas(V, F))
    face = np.minimum(np.searchsorted(end, (k - 0.5) * (end[-1] / _RAYS), side="right"), len(F) - 1)
    a, b, height, turn = (np.modf(k * 1.1673039782614187**-power)[0] for power in (1, 2, 3, 4))
    a = np.sqrt(a)
    P = interpolate(V, F, face, np.stack([1 - a, a * (1 - b), a * b], 1))
    N = unit(area_vectors(V, F[face]))
    z = 2 * height - 1
    flat = np.sqrt(1 - z**2)
    ball = np.stack([flat * np.cos(2 * np.pi * turn), flat * np.sin(2 * np.pi * turn), z], 1)
    return P, N, unit(N + 0.999 * ball)  # a cosine law: as light falls on a face
