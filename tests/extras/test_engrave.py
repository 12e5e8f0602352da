"""Labels are read from inside, evenly deep, and break no promise of the pieces."""

import numpy as np
import pytest

from meshjig.check import judge
from meshjig.check.closed import is_closed_as_stl
from meshjig.extras.engrave import LETTERING, LabelFacts, engrave
from meshjig.extras.label_ground import label_grounds
from meshjig.extras.text import text_outline
from meshjig.solid.printable import printable
from tests.check.pieces import turned
from tests.extras.sheets import plate, whole_shell
from tests.meshes import Shape, half_sphere, noisy, saddle

FDM = LETTERING["fdm"]


def bowl(radius, thickness, n=6000):
    V, F = half_sphere(n)
    return whole_shell(Shape(V * radius / 50, F), thickness)


def read_from_inside(V, F, depth):
    """Give what a reader sees who looks up at the lower side of a plate: across to the right, up."""
    import manifold3d
    import shapely.affinity

    mesh = manifold3d.Mesh64(np.ascontiguousarray(V), F.astype(np.uint64))
    section = manifold3d.Manifold(mesh).slice(float(V[:, 2].min()) + depth)
    loops = [shapely.Polygon(loop) for loop in section.to_polygons()]
    solid = max(loops, key=lambda loop: loop.area)
    groove = solid
    for loop in sorted(loops, key=lambda loop: -loop.area):
        groove = loop if loop is solid else groove.symmetric_difference(loop)
    groove = solid.symmetric_difference(groove) if groove.area > solid.area / 2 else groove
    groove = shapely.transform(groove, lambda xy: xy * [-1, 1])
    x0, y0, x1, y1 = groove.bounds
    return shapely.affinity.translate(groove, -(x0 + x1) / 2, -(y0 + y1) / 2)


@pytest.mark.parametrize("label", ["47", "2", "12", "75"])
def test_text_is_the_right_way_round(label):
    import shapely.affinity

    piece, outer, D = plate(40, 30, 2.0)
    [(V, F)], facts = engrave([piece], [label], label_grounds([piece], outer, D), FDM)
    assert facts == LabelFacts(1, 5.0, {})
    seen = read_from_inside(V, F, 1e-3)
    wanted = text_outline(label, 5.0, 0.8)
    mirrored = shapely.affinity.scale(wanted, -1, 1)
    assert seen.symmetric_difference(wanted).area < 0.1 * wanted.area
    assert seen.symmetric_difference(mirrored).area > 0.3 * wanted.area


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_volume_taken_is_that_of_the_groove(seed):
    from meshjig.check.closed import volume

    piece, outer, D = plate(40, 30, 2.0)
    solid = turned(piece, seed)
    sheet = turned((outer.V, outer.F), seed)
    way = turned((outer.V + D, outer.F), seed)[0] - sheet[0]
    [(V, F)], _ = engrave([solid], ["35"], label_grounds([solid], type(outer)(*sheet), way), FDM)
    outline = text_outline("35", 5.0, 0.8)
    expected = 0.4 * (outline.area - 0.62 * 0.4 * outline.length / 2)
    assert volume(*solid) - volume(V, F) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize(
    "made",
    [
        bowl(40, 2.0),
        bowl(15, 2.0),
        whole_shell(saddle(4000), 2.0),
        whole_shell(noisy(half_sphere(4000), 0.03), 2.0),
    ],
    ids=["bowl", "small bowl", "saddle", "noisy bowl"],
)
def test_engraved_pieces_are_as_sound_as_before(made):
    piece, outer, D = made
    [(V, F)], facts = engrave([piece], ["128"], label_grounds([piece], outer, D), FDM, min_wall=1.2)
    assert facts.engraved == 1
    assert len(F) > len(piece[1])
    V, F = printable(V, F)
    verdict = judge([(V, F)], thickness=2.0, min_wall=1.2)
    assert verdict.ok, verdict.failures
    assert not verdict.named["thin_walls"]


@pytest.mark.parametrize("radius", [15, 25, 60])
def test_depth_is_even_on_a_curved_sheet(radius):
    piece, outer, D = bowl(radius, 2.0, 20_000)
    [(V, _)], _ = engrave([piece], ["8"], label_grounds([piece], outer, D), FDM)
    deep = np.linalg.norm(V, axis=1) - (radius - 2.0)
    floor = deep[(deep > 0.15) & (deep < 1.0)]
    assert len(floor) > 20
    assert np.median(floor) == pytest.approx(0.4, abs=0.03)
    assert floor.max() < 0.5


@pytest.mark.parametrize("thickness", [1.0, 1.2, 2.0, 4.0])
def test_no_more_than_a_third_of_the_wall_is_taken_and_the_least_wall_is_left(thickness):
    piece, outer, D = plate(40, 30, thickness)
    for min_wall in (0.0, 0.8, 1.6):
        [(V, _)], facts = engrave([piece], ["8"], label_grounds([piece], outer, D), FDM, min_wall=min_wall)
        left = -V[(V[:, 2] < -1e-6) & (V[:, 2] > -thickness + 1e-6), 2]
        possible = min(0.35 * thickness, thickness - min_wall) >= 0.6 * 0.4
        assert facts.engraved == possible
        if possible:
            assert left.min() >= max(min_wall, 0.65 * thickness) - 1e-6
        else:
            assert "wall is under" in facts.skipped["8"]


def test_piece_without_room_is_left_alone_and_said_so():
    small, outer, D = plate(6, 5, 2.0)
    [(V, F)], facts = engrave([small], ["88"], label_grounds([small], outer, D), FDM)
    assert V is small[0]
    assert F is small[1]
    assert facts.skipped == {"88": "its inner side is too small or too curved"}
    elsewhere = Shape(small[0] + [0, 0, 50.0], small[1])
    assert engrave([elsewhere], ["88"], label_grounds([elsewhere], outer, D), FDM)[1].skipped == {
        "88": "it has no inner side"
    }


def test_text_shrinks_to_the_least_height_and_no_further():
    heights = []
    for side in (10.0, 6.0, 5.5, 4.5):
        piece, outer, D = plate(side, side, 2.0)
        heights.append(engrave([piece], ["4"], label_grounds([piece], outer, D), FDM)[1].least_height_mm)
    assert heights == [5.0, 4.5, 4.0, None]


def test_order_and_outer_sides_stay():
    first, outer, D = plate(40, 30, 2.0)
    away = [100.0, 0, 0]
    both = [first, Shape(first[0] + away, first[1])]
    sheet = type(outer)(
        np.concatenate([outer.V, outer.V + away]), np.concatenate([outer.F, outer.F + len(outer.V)])
    )
    made, facts = engrave(both, ["1", "2"], label_grounds(both, sheet, np.concatenate([D, D])), FDM)
    assert facts.engraved == 2
    for (V, F), (W, _) in zip(made, both, strict=True):
        assert is_closed_as_stl(V, F)
        assert np.allclose([V.min(0), V.max(0)], [W.min(0), W.max(0)])
        assert np.isclose((V[:, 2] == 0).sum(), (W[:, 2] == 0).sum())
