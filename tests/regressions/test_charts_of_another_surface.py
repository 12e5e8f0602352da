"""A small thin part on a surface that is laid out in tiles."""

import numpy as np
import trimesh

from meshjig.options import Options
from meshjig.pipeline.ground import surface_to_lay_out
from meshjig.pipeline.prepare import clean_scan
from meshjig.pipeline.work_mesh import work_atlas, work_mesh


def test_charts_are_of_the_surface_that_is_laid_out_with_a_small_far_side() -> None:
    """Faces were cut along its rim; the charts were those of the surface before."""
    fin = trimesh.creation.box((1.5, 8, 16), trimesh.transformations.translation_matrix((0, 0, 15)))
    solid = trimesh.creation.box((30, 30, 30)).union(fin).subdivide_to_size(1.5)
    options = Options.of(pieces=8, layout="tiles", charts="lscm")
    scan = clean_scan((np.asarray(solid.vertices), np.asarray(solid.faces)), options)
    surface, longest = work_mesh(scan.mesh, options)
    ground = surface_to_lay_out(surface, options)
    assert ground.thin is not None
    assert ground.thin.far.any()
    assert len(ground.face) == len(ground.surface.F) > len(surface.F)
    assert np.array_equal(work_atlas(scan, ground, longest, options).mesh.F, ground.mesh.F)
