"""The model that a puzzle was made of, as it was read, and points spread over meshes."""

from __future__ import annotations

from typing import Any, NamedTuple

import igl
import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import interpolate, unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene
from meshjig.options import Options
from meshjig.pipeline.prepare import clean_scan

__all__ = ["ON_SURFACE", "TURNED", "Model", "spread"]

TURNED = -0.5  # cosine between normals that are turned by 120 degrees
SKIN = 1e-4  # mm below a surface, where rays start: Embree works in float32
ON_SURFACE = 0.02  # mm: files of pieces hold float32, and short edges are mended


class Model(NamedTuple):
    """A model in mm, ready for questions."""

    mesh: Mesh
    normal: Floats  # (m, 3), unit
    scene: RayScene

    @classmethod
    def of(cls, model: Any, asked: dict[str, Any]) -> Model:
        """Read a model, a path or (V, F), as the options in a report ask."""
        scan = clean_scan(model, Options.of(**asked))
        mesh = Mesh(scan.mesh.V, scan.mesh.F)
        return cls(mesh, unit(mesh.area_vectors), RayScene(mesh.V, mesh.F))

    def thickness(self, points: Floats, inward: Floats) -> tuple[Floats, Floats]:
        """Say whether points lie on the surface, and how thick the model is below them.

        Parameters
        ----------
        points : (k, 3), mm
        inward : (k, 3), unit, the way that is measured along

        Returns
        -------
        on : (k,) bool, within 0.02 mm of a face that turns away from the way inward
        depth : (k,), mm, to the first face, where that is turned by over 120 degrees; else infinite
        """
        squared, face, foot = igl.point_mesh_squared_distance(points, self.mesh.V, self.mesh.F)
        on = (squared < ON_SURFACE**2) & (np.einsum("ij,ij->i", self.normal[face], inward) < -0.3)
        hit = self.scene.hits(foot + SKIN * inward, inward)
        met = np.asarray(hit["primID"], np.int64)
        back = np.einsum("ij,ij->i", self.normal[met], self.normal[face]) <= TURNED
        return on, np.where((met >= 0) & back, np.asarray(hit["tfar"], float) + SKIN, np.inf)


def spread(mesh: Mesh, n: int, seed: int = 0) -> tuple[Floats, Ints]:
    """Spread n points over a mesh, each standing for the same area; points (n, 3) and their faces (n,)."""
    end = np.cumsum(mesh.areas)
    face = np.searchsorted(end, (np.arange(n) + 0.5) * (end[-1] / n))
    a, b = np.random.default_rng(seed).random((2, n))
    a = np.sqrt(a)
    return interpolate(mesh.V, mesh.F, face, np.stack([1 - a, a * (1 - b), a * b], 1)), face
