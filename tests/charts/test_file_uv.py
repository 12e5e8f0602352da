"""Charts from a file's own UVs: cut where it cuts, turned where it mirrors, or refused in a sentence."""

import numpy as np
import pytest
import trimesh

from meshjig.charts.chart import Chart
from meshjig.charts.file_uv import closed_around, file_uv
from meshjig.errors import ChartError
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.scan import read_scan
from tests.charts.helpers import all_turn_left
from tests.meshes import half_sphere, joined, moved

GIRTH, HEIGHT, AROUND, ROWS = 90.0, 60.0, 45, 30


def sheet(u_share=1.0):
    """A tube with a seam, as files hold it: vertices on the seam twice. V, F and UVs from 0 to 1."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(AROUND + 1), np.arange(ROWS + 1), indexing="ij"))
    angle = 2 * np.pi * i / AROUND * u_share
    V = np.stack(
        [np.cos(angle) * GIRTH / 2 / np.pi, j * HEIGHT / ROWS, -np.sin(angle) * GIRTH / 2 / np.pi], 1
    )
    a = (np.arange(AROUND)[:, None] * (ROWS + 1) + np.arange(ROWS)[None]).ravel()
    b = a + ROWS + 1
    F = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    return V, F, np.stack([i / AROUND, j / ROWS * HEIGHT / GIRTH], 1)


def ball():
    """Two half spheres with a round island each; the lower one is mirrored in the texture."""
    upper = half_sphere(1500)
    lower = type(upper)(upper.V * [1, 1, -1], upper.F[:, ::-1])
    V, F = joined(upper, lower)
    angle = np.arccos(np.clip(upper.V[:, 2] / 50, -1, 1))[:, None]
    spoke = upper.V[:, :2] / np.maximum(np.linalg.norm(upper.V[:, :2], axis=1, keepdims=True), 1e-12)
    disc = spoke * angle / np.pi / 2.2
    return V, F, np.concatenate([disc, disc + np.array([0.5, 0.0])])


def textured(V, F, uv):
    return trimesh.Trimesh(V, F, process=False, visual=trimesh.visual.TextureVisuals(uv=uv))


def charted(source, faces="all"):
    scan = read_scan(source, size=100.0, faces=faces)
    return scan.mesh, file_uv(scan.mesh, scan.source, scan.to_source)


def assert_sound(mesh, charts):
    faces = np.concatenate([chart.faces for chart in charts])
    np.testing.assert_array_equal(np.sort(faces), np.arange(len(mesh.F)))
    for chart in charts:
        assert all_turn_left(chart.uv, chart.corners)
        stretch = singular_values(mesh.V, mesh.F[chart.faces], chart.uv, chart.corners)
        area = face_areas(mesh.V, mesh.F[chart.faces])
        assert np.average(np.log(stretch).sum(1), weights=area) == pytest.approx(0, abs=1e-6)


def test_an_isometric_tube_is_one_chart_cut_at_its_seam():
    mesh, charts = charted(textured(*sheet()))
    assert_sound(mesh, charts)
    (chart,) = charts
    assert len(chart.uv) == len(mesh.V) + ROWS + 1  # the seam twice
    stretch = singular_values(mesh.V, mesh.F[chart.faces], chart.uv, chart.corners)
    np.testing.assert_allclose(stretch, 1, atol=3e-3)


@pytest.mark.parametrize("faces", ["all", 800])
def test_a_ball_has_its_two_islands_and_the_mirrored_one_is_turned(faces):
    mesh, charts = charted(textured(*ball()), faces)
    assert_sound(mesh, charts)
    assert len(charts) == 2
    for chart in charts:
        z = mesh.V[mesh.F[chart.faces]].mean(1)[:, 2]
        assert (z > -6).all() or (z < 6).all()
        rows, place = np.unique(chart.corners, return_index=True)
        where = mesh.V[mesh.F[chart.faces].ravel()[place]]
        top = chart.uv[rows[np.abs(where[:, 2]).argmax()]]
        away = np.linalg.norm(chart.uv[rows] - top, axis=1)
        truth = np.arccos(np.clip(np.abs(where[:, 2]) / 50, -1, 1))
        assert np.corrcoef(away, truth)[0, 1] > 0.98  # the island's own map, not another


def test_a_decimated_tube_keeps_its_seam_and_its_map():
    mesh, charts = charted(textured(*sheet()), 900)
    assert_sound(mesh, charts)
    (chart,) = charts
    assert len(mesh.F) <= 900
    assert np.ptp(chart.uv, axis=0) == pytest.approx(np.array([GIRTH, HEIGHT]) * 100 / HEIGHT, rel=0.03)


def test_vertices_split_at_creases_are_no_seams():
    V, F, uv = sheet(0.6)
    flat = textured(V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3), uv[F].reshape(-1, 2))
    mesh, charts = charted(flat)
    assert_sound(mesh, charts)
    assert len(charts) == 1
    assert len(charts[0].uv) == len(mesh.V)


def test_uvs_survive_a_round_trip_through_obj(tmp_path):
    V, F, uv = ball()
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in V] + [f"vt {u:.6f} {v:.6f}" for u, v in uv]
    lines += ["f " + " ".join(f"{k + 1}/{k + 1}" for k in face) for face in F]
    (tmp_path / "ball.obj").write_text("\n".join(lines) + "\n")
    mesh, charts = charted(tmp_path / "ball.obj")
    assert_sound(mesh, charts)
    assert len(charts) == 2


def wrapped():
    V, F, uv = sheet()
    return V, np.where(F >= AROUND * (ROWS + 1), F - AROUND * (ROWS + 1), F), uv


def bad_uvs():
    V, F, uv = sheet()
    yield "missing", trimesh.Trimesh(V, F, process=False), "no UVs"
    yield "one point", textured(V, F, uv * 0), "no area"
    yield "folded", textured(V, F, np.stack([np.abs(uv[:, 0] - 0.5), uv[:, 1]], 1)), "fold near"
    yield "around the edge", textured(*wrapped()), "go around the edge of the texture"
    angle, reach = 9 * uv[:, 0], 0.2 + uv[:, 1]
    yield (
        "overlapping",
        textured(V, F, np.stack([reach * np.cos(angle), reach * np.sin(angle)], 1)),
        "overlap",
    )
    parts = joined(*[moved(type(half_sphere(20))(V, F), [60.0 * k, 0, 0]) for k in range(70)])
    yield (
        "in shreds",
        textured(*parts, np.concatenate([uv + np.array([k, 0]) for k in range(70)])),
        "70 islands",
    )


@pytest.mark.parametrize(("source", "words"), [c[1:] for c in bad_uvs()], ids=[c[0] for c in bad_uvs()])
def test_bad_uvs_are_refused_with_what_is_wrong_and_what_to_do(source, words):
    with pytest.raises(ChartError, match=f"{words}.*use --charts auto"):
        charted(source)


def test_a_texture_that_repeats_is_no_fault_of_its_islands():
    V, F, uv = sheet()
    mesh, charts = charted(textured(V, F, uv * 7 - 3))
    assert_sound(mesh, charts)
    assert len(charts) == 1


def test_the_textured_bunny_is_refused():
    import pymeshlab

    path = pymeshlab.__path__[0] + "/tests/sample_meshes/bunny10k_textured.obj"
    with pytest.raises(ChartError, match="190 islands"):
        charted(path)


def test_a_ball_inside_out_keeps_its_islands():
    V, F, uv = ball()
    mesh, charts = charted(textured(V, F[:, ::-1], uv))
    assert_sound(mesh, charts)
    assert len(charts) == 2


def test_a_tube_cut_along_a_line_goes_around():
    _, (chart,) = charted(textured(*sheet()))
    left, right = chart.uv[:, 0].min(), chart.uv[:, 0].max()
    assert right - left == chart.period > 0


GIRTH, HEIGHT, AROUND, ROWS = 90.0, 60.0, 45, 30


def strip(turn=0.0, shear=0.0, stretch=None):
    """A tube's faces (rows welded around) and the flat strip that they make, turned and sheared."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(AROUND + 1), np.arange(ROWS + 1), indexing="ij"))
    a = (np.arange(AROUND)[:, None] * (ROWS + 1) + np.arange(ROWS)[None]).ravel()
    b = a + ROWS + 1
    corners = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    F = (corners // (ROWS + 1) % AROUND) * (ROWS + 1) + corners % (ROWS + 1)
    v = j * HEIGHT / ROWS
    u = i * GIRTH / AROUND * (1.0 if stretch is None else 1 + stretch * v / HEIGHT) + shear * v
    c, s = np.cos(turn), np.sin(turn)
    uv = np.stack([u, v], 1) @ np.array([[c, s], [-s, c]])
    return F, Chart(np.arange(len(F)), uv, corners)


def assert_closes(F, chart):
    """All that was cut is closed: edges of the tube with two places in the plane have them a period apart."""
    e = edges(F)
    G, h = chart.corners.ravel(), np.arange(3 * len(F))
    following = np.where(h % 3 == 2, h - 2, h + 1)
    inner = e.twin != h
    apart = chart.uv[G[h]] - chart.uv[G[following[e.twin]]]
    moved = apart[inner & (np.abs(apart).max(1) > 1e-9)]
    assert len(moved) == 2 * ROWS
    np.testing.assert_array_equal(np.abs(moved), np.tile([chart.period, 0.0], (len(moved), 1)))


@pytest.mark.parametrize("turn", [0.0, 0.7, np.pi / 2, 3.0, -2.0])
@pytest.mark.parametrize("shear", [0.0, 0.4])
def test_a_cut_tube_is_closed_whichever_way_it_lies(turn, shear):
    F, cut = strip(turn, shear)
    chart = closed_around(cut, edges(F))
    assert chart.period == pytest.approx(GIRTH, abs=2.0**-8)
    assert_closes(F, chart)
    assert all_turn_left(chart.uv, chart.corners)


def test_a_wavy_cut_is_closed_too():
    F, cut = strip()
    wave = 3 * np.sin(cut.uv[:, 1:] / 7)
    chart = closed_around(Chart(cut.faces, cut.uv + wave * [1.0, 0.0], cut.corners), edges(F))
    assert_closes(F, chart)


def test_a_fan_is_not_closed():
    """A cone's strip whose sides part by a tenth has no one period."""
    F, cut = strip(stretch=0.1)
    assert closed_around(cut, edges(F)) is cut


def test_a_disc_without_cuts_stays_as_it_is():
    _, cut = strip()
    assert closed_around(cut, edges(cut.corners)) is cut


def test_a_strip_whose_sides_bulge_alike_is_closed():
    """One side reaches far over where the next copy's box begins, but fits into its other side."""
    F, cut = strip()
    bulge = 60 * np.sin(np.pi * cut.uv[:, 1:] / HEIGHT) * [1.0, 0.0]
    assert_closes(F, closed_around(Chart(cut.faces, cut.uv + bulge, cut.corners), edges(F)))
