"""A triangle mesh, with what follows from its faces worked out once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, row_of, starts
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import area_vectors, face_areas, vertex_normals

__all__ = ["Concatenated", "Mesh", "concatenate"]


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh in mm: manifold, oriented outward, without unused vertices.

    It unpacks as ``V, F``. What follows from these is worked out when it is first asked for, and kept; nobody
    changes the arrays.
    """

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)

    def __iter__(self) -> Iterator[Any]:
        return iter((self.V, self.F))

    @cached_property
    def edges(self) -> Edges:
        """The edges, and the half-edges in pairs."""
        return edges(self.F)

    @cached_property
    def borders(self) -> Ints:
        """The half-edges without a twin, (b,)."""
        twin = self.edges.twin
        return np.flatnonzero(twin == np.arange(len(twin)))

    @property
    def inner_halfedges(self) -> Ints:
        """One half-edge of every edge between two faces, that with the lower number, (i,)."""
        twin = self.edges.twin
        return np.flatnonzero(twin > np.arange(len(twin)))

    @cached_property
    def areas(self) -> Floats:
        """The area of each face, (m,), mm2."""
        return face_areas(self.V, self.F)

    @cached_property
    def area_vectors(self) -> Floats:
        """The normal of each face, twice as long as its area, (m, 3)."""
        return area_vectors(self.V, self.F)

    @cached_property
    def vertex_normals(self) -> Floats:
        """The area-weighted unit normals of the vertices, (n, 3)."""
        return vertex_normals(self.V, self.F)

    @cached_property
    def component_of_face(self) -> Ints:
        """The connected component that each face is in, (m,)."""
        return components(self.F, twin=self.edges.twin)[1]

    @cached_property
    def n_components(self) -> int:
        """How many connected components there are."""
        return int(self.component_of_face.max(initial=-1)) + 1

    @cached_property
    def is_border_vertex(self) -> Bools:
        """Whether each vertex lies on a border, (n,)."""
        on_border = np.zeros(len(self.V), bool)
        on_border[self.edges.E[self.edges.n_faces == 1]] = True
        return on_border

    def moved(self, V: Floats) -> Mesh:
        """The same faces, and what is known of their edges, with vertices (n, 3) elsewhere."""
        if V is self.V:
            return self
        other = Mesh(V, self.F)
        if "edges" in self.__dict__:
            other.__dict__["edges"] = self.edges
        return other

    def __getstate__(self) -> dict[str, Floats | Ints]:
        return {"V": self.V, "F": self.F}  # to another process go the arrays alone


class _Triangles(Protocol):
    @property
    def V(self) -> Floats: ...

    @property
    def F(self) -> Ints: ...


class Concatenated(NamedTuple):
    """Several meshes as one, and which of them everything is from."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    part_of_vertex: Ints  # (n,), counted from 0
    part_of_face: Ints  # (m,)


def concatenate(parts: Sequence[_Triangles]) -> Concatenated:
    """Put meshes, at least one, into one, in their order; they are not joined."""
    n_vertices = np.array([len(part.V) for part in parts])
    n_faces = np.array([len(part.F) for part in parts])
    V = np.concatenate([part.V for part in parts])
    F = np.concatenate([part.F + first for part, first in zip(parts, starts(n_vertices), strict=True)])
    return Concatenated(V, F, row_of(n_vertices), row_of(n_faces))
