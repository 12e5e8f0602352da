"""The gap is a band of the asked width on the surface, over seams and creases too."""

import numpy as np
import pytest

from meshjig.cut.gap_bands import gap_outlines
from meshjig.cut.overlay import overlay
from meshjig.cut.transfer_pieces import transfer_pieces
from meshjig.errors import CutError
from meshjig.layout.outer_gap import outer_gap
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import GAP, Atlas, Mesh
from tests.cut.graphs import SIDE, atlas, flat_sheet, grid_graph, loops, sheet_atlas, square, two_charts

CLEARANCE = 0.4
LINES = np.linspace(-10, SIDE + 10, 7)


def flat_atlas(n, stretch=(1.0, 1.0)):
    """A flat sheet whose chart is stretched: a mm in the plane is less on the surface."""
    p, F = flat_sheet(n)
    return atlas(np.c_[p, np.zeros(len(p))], F, p * stretch)


def folded(sheet, degrees):
    """Bend a two-chart sheet along its seam."""
    V = sheet.mesh.V.copy()
    V[:, 2] = 0
    right = V[:, 0] > SIDE / 2
    angle = np.radians(degrees)
    V[right, 2] = -(V[right, 0] - SIDE / 2) * np.sin(angle)
    V[right, 0] = SIDE / 2 + (V[right, 0] - SIDE / 2) * np.cos(angle)
    return Atlas(Mesh(V, sheet.mesh.F), sheet.uv, sheet.F_uv, sheet.chart_of_face)


def cut_with_gap(sheet, outlines, method="stretch", pieces="label"):
    """Cut at zero width and with a gap; give the second cut, its pieces, and its specks."""
    cut = overlay(sheet, outlines)
    names = cut.label if pieces == "label" else sheet.chart_of_face[cut.parent]
    piece = np.unique(names, return_inverse=True)[1]
    parts = overlay(sheet, gap_outlines(sheet, cut, outlines, piece, CLEARANCE, method))
    return (cut, piece, parts, *transfer_pieces(cut, piece, parts))


@pytest.mark.parametrize("stretch", [(1.0, 1.0), (1.25, 0.8), (0.8, 0.8)])
@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_gap_on_the_surface_is_the_clearance_whatever_the_stretch(stretch, turn):
    sheet = flat_atlas(20, stretch)
    graph = grid_graph(LINES, LINES, parts=12, turn=turn)
    _, _, parts, piece, _ = cut_with_gap(sheet, graph)
    gap = outer_gap(parts.V, parts.F, piece, CLEARANCE)
    assert gap["within_10pct"] > 0.99
    assert gap["median"] == pytest.approx(CLEARANCE, rel=0.02)


def test_offset_in_the_domain_follows_the_stretch():
    _, _, parts, piece, _ = cut_with_gap(flat_atlas(20, (1.25, 1.25)), grid_graph(LINES, LINES, 12), "domain")
    gap = outer_gap(parts.V, parts.F, piece, CLEARANCE)
    assert gap["median"] == pytest.approx(CLEARANCE / 1.25, rel=0.02)


def test_area_of_the_band_is_length_times_clearance():
    lines = np.array([-10.0, 30.0, 70.0, 110.0])
    _, _, parts, piece, _ = cut_with_gap(flat_atlas(20), grid_graph(lines, lines, parts=12))
    area = face_areas(parts.V, parts.F)
    expected = 4 * SIDE * CLEARANCE - 4 * CLEARANCE**2
    assert area[piece == GAP].sum() == pytest.approx(expected, rel=0.01)
    assert len(np.unique(piece)) == 10


@pytest.mark.parametrize("degrees", [0, 60, 90, -90])
def test_gap_along_a_seam_is_straight_across_its_crease(degrees):
    sheet = folded(two_charts(20, (SIDE + 20, 7.0)), degrees)
    away = square(-50, -50, 1)
    _, _, parts, piece, _ = cut_with_gap(sheet, loops(away, labels=[0], outside=[1]), pieces="chart")
    gap = outer_gap(parts.V, parts.F, piece, CLEARANCE)
    assert len(np.unique(piece[piece != GAP])) == 2
    assert gap["within_10pct"] > 0.99


def test_a_band_beside_an_inner_seam_is_carried_over_it():
    # one cut runs 0.05 mm left of a seam that divides no pieces: most of its band lies on the other chart
    sheet = two_charts(20, (SIDE + 20, 7.0))
    V = sheet.mesh.V.copy()
    V[:, 2] = 0
    sheet = Atlas(Mesh(V, sheet.mesh.F), sheet.uv, sheet.F_uv, sheet.chart_of_face)
    x = SIDE / 2 - 0.05
    outline = loops(
        np.array([[-9.0, -9.0], [x, -9.0], [x, SIDE + 9], [-9.0, SIDE + 9]]), labels=[0], outside=[1]
    )
    _, _, parts, piece, _ = cut_with_gap(sheet, outline)
    gap = outer_gap(parts.V, parts.F, piece, CLEARANCE)
    assert gap["within_10pct"] > 0.97


def test_pieces_keep_their_names_and_places():
    sheet = sheet_atlas(30)
    cut, piece, parts, carried, specks = cut_with_gap(sheet, grid_graph(LINES, LINES, parts=8))
    before = np.bincount(piece, face_areas(cut.V, cut.F))
    kept = carried != GAP
    after = np.bincount(carried[kept], face_areas(parts.V, parts.F)[kept])
    assert len(specks) == 0
    assert (after < before).all()
    assert after.sum() > 0.95 * before.sum()
    middles = [
        np.array([V[F[p == i]].mean((0, 1)) for i in range(len(before))])
        for V, F, p in ((cut.V, cut.F, piece), (parts.V, parts.F, carried))
    ]
    nearest = np.linalg.norm(middles[0][:, None] - middles[1][None], axis=2).argmin(1)
    np.testing.assert_array_equal(nearest, np.arange(len(before)))


def test_a_piece_narrower_than_the_clearance_is_named():
    sheet = flat_atlas(20)
    lines = np.array([-10.0, 50.0, 50.3, 110.0])
    with pytest.raises(CutError, match="narrower than the clearance") as error:
        cut_with_gap(sheet, grid_graph(lines, np.array([-10.0, 110.0])))
    assert len(error.value.ids) == 1
