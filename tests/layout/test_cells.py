"""Cells end to end: equal areas, a knob wherever there is room, the same again from the same seed."""

import numpy as np
import pytest

from meshjig.cells import grow_cells
from meshjig.errors import CutError
from meshjig.layout.cells import cell_layout
from meshjig.layout.congruent import clashes
from meshjig.layout.interlock import interlock
from meshjig.mesh.components import is_disc
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.subdivide import refine_long_edges
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.runtime.progress import Stages
from tests.meshes import half_sphere, sphere, torus, two_components

SHAPES = {"closed": sphere, "handle": torus, "rim": half_sphere, "parts": two_components}


def laid_out(shape, pieces=24, **given):
    V, F = refine_long_edges(*shape(3000), 6.0)
    options = Options.of(pieces=pieces, process="sla", **given)
    return cell_layout(Mesh(V, F), options, Stages())


@pytest.mark.parametrize(
    ("name", "assembly", "least"),
    [*((name, "off", 1.0) for name in sorted(SHAPES)), ("closed", "any", 0.9), ("handle", "any", 0.6)],
)
def test_pieces_are_discs_of_equal_area_that_lock(name, assembly, least):
    layout = laid_out(SHAPES[name], assembly=assembly)
    piece, cut = layout.piece_of_face, layout.cut
    n = layout.stitching.n_pieces
    assert n == pytest.approx(24, abs=1)
    assert all(is_disc(cut.F[piece == p]) for p in range(n))
    area = sums(piece, face_areas(cut.V, cut.F), n)
    assert area.std() / area.mean() < 0.08
    assert area.min() > area.mean() / 2
    locks = interlock(cut, layout.knobs, piece)
    size = np.sqrt(area.mean())
    long = locks.length > 0.3 * size
    assert (locks.knobs_of_pair[long] > 0).mean() >= least  # others would keep a piece from going in
    assert (locks.head > 1.3 * locks.neck).all()


def test_cut_points_lie_on_the_surface_that_was_given():
    V, F = refine_long_edges(*torus(3000), 6.0)
    layout = cell_layout(Mesh(V, F), Options.of(pieces=24, process="sla"), Stages())
    carried = layout.carried(V, layout.cut)
    np.testing.assert_allclose(carried, layout.cut.V, atol=1e-6)
    N = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    face = layout.face_of_surface
    off = layout.cut.V[layout.cut.F].mean(1) - V[F[face, 0]]
    height = np.einsum("ij,ij->i", off, N[face]) / np.linalg.norm(N[face], axis=1)
    assert np.abs(height).max() < 1e-6


def test_cells_that_become_rings_on_the_way_to_even_areas_leave_those_before(monkeypatch):
    asked = []

    def grow(*surface, start, **given):
        asked.append(start)
        if start is not None:
            raise CutError("a ring")
        return grow_cells(*surface, start=start, **given)

    monkeypatch.setattr("meshjig.layout.cells.grow_cells", grow)
    layout = laid_out(sphere)
    assert len(asked) == 2
    assert layout.stitching.n_pieces == pytest.approx(24, abs=1)


def test_the_same_seed_gives_the_same_cells_and_another_one_others():
    one, again, other = (laid_out(sphere, seed=seed) for seed in (3, 3, 4))
    assert np.array_equal(one.cut.F, again.cut.F)
    assert np.array_equal(one.cut.V, again.cut.V)
    assert not np.array_equal(one.cut.V[: len(other.cut.V)], other.cut.V[: len(one.cut.V)])


def test_no_border_looks_like_another_where_pieces_are_to_be_unique():
    assert clashes(laid_out(sphere, assembly="off"), 0.15)[1].congruent_borders > 0
    assert clashes(laid_out(sphere, assembly="off", unique=True), 0.15)[1].congruent_borders == 0
