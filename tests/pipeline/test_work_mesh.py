"""The mesh that a puzzle is cut from has short edges, and no needles."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import edge_lengths
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.work_mesh import work_mesh
from tests.meshes import creased_box


def rod(sides, height=60.0, radius=20.0):
    """Give a rod of so many sides: each two needles as high as the rod, and caps of fans."""
    turn = 2 * np.pi * np.arange(sides) / sides
    ring = radius * np.stack([np.cos(turn), np.sin(turn)], 1)
    low, high = (np.column_stack([ring, np.full(sides, z)]) for z in (0.0, height))
    V = np.concatenate([low, high, [[0, 0, 0], [0, 0, height]]])
    a, b, bottom, top = np.arange(sides), np.roll(np.arange(sides), -1), 2 * sides, 2 * sides + 1
    walls = [[a, b, a + sides], [b, b + sides, a + sides]]
    caps = [[b, a, np.full(sides, bottom)], [a + sides, b + sides, np.full(sides, top)]]
    return Mesh(V, np.concatenate([np.stack(part, 1) for part in (*walls, *caps)]))


def test_no_edge_is_longer_than_a_quarter_of_a_piece():
    mesh, longest = work_mesh(Mesh(*creased_box(12)), Options.of(pieces=50))
    assert edge_lengths(mesh.V, edges(mesh.F).E).max() <= longest
    assert longest == pytest.approx(np.sqrt(mesh.areas.sum() / 50) / 4)


def test_needles_are_refused_at_once_and_resurfacing_is_advised():
    with pytest.raises(InputError, match=r"needles.*--resurface"):
        work_mesh(rod(100_000), Options.of(pieces=100))
    open_rod = Mesh(*rod(100_000))
    with pytest.raises(InputError, match=r"needles.*MeshLab"):
        work_mesh(Mesh(open_rod.V, open_rod.F[:-1]), Options.of(pieces=100))


def test_slender_faces_of_a_modeller_are_cut():
    assert len(work_mesh(rod(200), Options.of(pieces=100))[0].F) > 400
