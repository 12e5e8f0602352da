"""How much of a model is thin, and the size that cures it."""

import numpy as np
import pytest
import trimesh

from meshjig.mesh.mesh import Mesh
from meshjig.scan.thin_share import thin_shares


def plate(thickness, *more):
    """Make a plate of 60 x 40 mm, and what stands beside it."""
    parts = [trimesh.creation.box((60, 40, thickness)).subdivide().subdivide(), *more]
    whole = trimesh.util.concatenate(parts)
    return Mesh(np.asarray(whole.vertices, float), np.asarray(whole.faces, np.int64))


def test_the_share_is_that_of_the_area():
    mesh = plate(3.0)
    thin, sturdy = thin_shares(mesh, [5.0, 1.2])
    assert thin.area_share == pytest.approx(4800 / (4800 + 600), abs=1e-6)
    assert thin.thinnest_mm == pytest.approx(3.0, abs=1e-3)
    assert abs(thin.thinnest_at[2]) == pytest.approx(1.5)
    assert (sturdy.area_share, sturdy.thinnest_mm, sturdy.thinnest_at) == (0.0, None, None)
    assert sturdy.none_from_size_mm == 60


@pytest.mark.parametrize("limit", [1.2, 5.0])
def test_nothing_is_thin_from_the_size_on_that_is_named(limit):
    mesh = plate(0.9)
    needed = thin_shares(mesh, [limit])[0].none_from_size_mm
    for scale, thin in ((1.01, False), (0.99, True)):
        (found,) = thin_shares(Mesh(mesh.V * needed / 60 * scale, mesh.F), [limit])
        assert (found.area_share > 0.5) == thin
        assert (found.thinnest_mm is not None) == thin


@pytest.mark.parametrize(("width", "counts"), [(1.0, False), (3.0, True)])
def test_less_than_a_thousandth_of_the_area_counts_as_nothing(width, counts):
    crumb = trimesh.creation.box((width, width, 0.1)).apply_translation([0, 0, 30])
    (found,) = thin_shares(plate(3.0, crumb), [1.2])
    assert 0 < found.area_share < 0.01
    assert (found.none_from_size_mm > 60) == counts
    assert (found.thinnest_mm is not None) == counts


def test_an_open_surface_is_not_thin():
    sheet = trimesh.creation.box((60, 40, 1)).subdivide().subdivide()
    top = Mesh(np.asarray(sheet.vertices, float), np.asarray(sheet.faces[sheet.face_normals[:, 2] > 0.5]))
    assert thin_shares(top, [5.0])[0].area_share == 0
