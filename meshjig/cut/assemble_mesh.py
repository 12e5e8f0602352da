"""Put the pieces of the overlay together to one mesh."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.cycles import Cycles
from meshjig.cut.inner_halfedges import Ring
from meshjig.cut.islands import Origin, in_mesh
from meshjig.cut.places import Places
from meshjig.cut.triangulate import Filling
from meshjig.cut.uv_mesh import Sheet
from meshjig.mesh.types import Floats, Ints

__all__ = ["Faces", "assemble_faces", "place_vertices"]


class Faces(NamedTuple):
    """The faces of the cut mesh: untouched ones first."""

    F: Ints  # (f, 3)
    face: Ints  # (f,), the face of the sheet that each was cut from
    region: Ints  # (f,)


def assemble_faces(
    sheet: Sheet, ring: Ring, places: Places, parts: Cycles, filling: Filling, regions: tuple[Ints, Ints]
) -> Faces:
    """Put untouched faces and the triangles in cut ones together.

    Parameters
    ----------
    regions : (of_face, of_part)
    """
    of_face, of_part = regions
    untouched = np.flatnonzero(ring.row < 0)
    n_placed = places.n_vertices
    vertex = np.append(places.vertex, n_placed + np.arange(len(filling.centre_part)))
    face_of_part = ring.faces[places.row[parts.members[parts.first]]]
    return Faces(
        np.concatenate([sheet.F[untouched], vertex[filling.T]]),
        np.concatenate([untouched, face_of_part[filling.part]]),
        np.concatenate([of_face[untouched], of_part[filling.part]]),
    )


def place_vertices(
    sheet: Sheet, origin: Origin, ring: Ring, places: Places, parts: Cycles, filling: Filling
) -> tuple[Floats, Ints, Floats]:
    """Place all vertices of the cut mesh.

    Returns
    -------
    V : (n, 3) float64
    face : (n,) int64, a face of the mesh that each lies in
    bary : (n, 3) float64, where it lies in that face
    """
    n_old, n_placed = len(sheet.V), places.n_vertices
    face = np.zeros(n_placed + len(filling.centre_part), np.int64)
    bary = np.zeros((len(face), 3))
    for k in range(3):
        face[sheet.F[:, k]] = np.arange(len(sheet.F))
    bary[:n_old] = sheet.F[face[:n_old]] == np.arange(n_old)[:, None]
    new = np.flatnonzero(places.vertex >= n_old)
    face[places.vertex[new]] = ring.faces[places.row[new]]
    bary[places.vertex[new]] = places.bary[new]
    face[n_placed:] = ring.faces[places.row[parts.members[parts.first[filling.centre_part]]]]
    bary[n_placed:] = filling.centre_bary

    V = np.empty((len(face), 3))
    V[:n_old] = sheet.V
    V[n_old:] = np.einsum("nk,nkd->nd", bary[n_old:], sheet.V[sheet.F[face[n_old:]]])
    face, bary = in_mesh(origin, face, bary)
    return V, face, bary
