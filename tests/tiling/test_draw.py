"""The picture shows every tile once, where it belongs, the unit set off from its copies."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from meshjig.tiling.draw import draw_svg
from meshjig.tiling.registry import get_decor, get_family

NAMES = ["classic", "macro", "hex", "polyomino", "isohedral:IH88", "escher"]
SVG = "{http://www.w3.org/2000/svg}"


def groups(text):
    """Per group of the picture: polygons and their fill."""
    root = ElementTree.fromstring(text)
    return root, [
        [
            (polygon(path.get("d")), path.get("fill"))
            for path in group.iter(f"{SVG}path")
            if path.get("fill") != "none"
        ]
        for group in root.iter(f"{SVG}g")
    ]


def polygon(d):
    assert re.fullmatch(r"M[-0-9.,L]+Z", d)
    return shapely.Polygon([tuple(map(float, p.split(","))) for p in d[1:-1].split("L")])


@pytest.mark.parametrize("name", NAMES)
def test_every_tile_is_drawn_once_and_none_overlaps(name):
    unit = get_family(name)
    _, (around, inside) = groups(draw_svg(unit, (3, 2), get_decor(name)))
    tiles = [tile for tile, _ in around + inside]
    assert len(tiles) == 6 * unit.n_tiles
    assert len(inside) == unit.n_tiles
    area = sum(tile.area for tile in tiles)
    assert area == pytest.approx(6 * unit.n_tiles * 25.0**2, rel=1e-3)
    assert shapely.union_all(tiles).buffer(0.002).area == pytest.approx(area, rel=2e-3)


@pytest.mark.parametrize("name", NAMES)
def test_page_is_in_mm_and_holds_the_drawing(name):
    root, drawn = groups(draw_svg(get_family(name)))
    x, y, width, height = map(float, root.get("viewBox").split())
    assert (root.get("width"), root.get("height")) == (f"{width:.3f}mm", f"{height:.3f}mm")
    everything = shapely.union_all([tile for group in drawn for tile, _ in group])
    assert shapely.box(x, y, x + width, y + height).buffer(-4.9).contains(everything)


@pytest.mark.parametrize("name", NAMES)
def test_neighbours_differ_in_colour_and_the_unit_from_the_rest(name):
    _, (around, inside) = groups(draw_svg(get_family(name)))
    assert not {fill for _, fill in around} & {fill for _, fill in inside}
    for group in (around, inside):
        tiles = np.array([tile for tile, _ in group])
        a, b = shapely.STRtree(tiles).query(tiles, predicate="dwithin", distance=0.01)
        touching = [
            (i, j)
            for i, j in zip(a, b, strict=True)
            if i < j and tiles[i].buffer(0.01).intersection(tiles[j]).area > 0.05
        ]
        assert all(group[i][1] != group[j][1] for i, j in touching)


def test_drawing_is_not_mirrored():
    """Tiles run counterclockwise where y points up, so clockwise in a file, where it points down."""
    _, drawn = groups(draw_svg(get_family("macro")))
    assert not any(tile.exterior.is_ccw for group in drawn for tile, _ in group)


def test_lines_inside_a_figure_are_drawn_in_each_of_its_tiles():
    name = "escher:lizard"
    decor = get_decor(name)
    root, drawn = groups(draw_svg(get_family(name), (2, 2), decor))
    lines = [
        shapely.LineString([tuple(map(float, p.split(","))) for p in path.get("d")[1:].split("L")])
        for path in root.iter(f"{SVG}path")
        if path.get("fill") == "none"
    ]
    tiles = [tile for group in drawn for tile, _ in group]
    assert len(lines) == 4 * sum(map(len, decor)) > 0
    holding = [[tile for tile in tiles if tile.buffer(0.5).contains(line)] for line in lines]
    assert all(len(found) == 1 for found in holding)
    assert len({id(found[0]) for found in holding}) == len(tiles)
