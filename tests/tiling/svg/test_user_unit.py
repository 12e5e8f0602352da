"""A drawing becomes a tiling; what is wrong with one is said, with the place in its own coordinates."""

import logging
import re

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.registry import get_family
from meshjig.tiling.svg.user_unit import user_unit
from tests.tiling.tilings import cover_counts, is_moved, outlines

HEAD = (
    '<?xml version="1.0" encoding="UTF-8" standalone="no"?>\n'
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
    'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" '
)
A4 = 'width="210mm" height="297mm" viewBox="0 0 210 297"'
HIDDEN = """
<sodipodi:namedview id="namedview1" pagecolor="#ffffff" inkscape:document-units="mm"/>
<defs id="defs1"><rect id="unused" x="0" y="0" width="9" height="9"/></defs>
<g inkscape:groupmode="layer" inkscape:label="sketch" style="display:none"><path d="M 0,0 H 9"/></g>
<g style="visibility:hidden"><rect x="30" y="40" width="30" height="30"/></g>
<text x="60" y="70" style="font-size:5px"><tspan x="60" y="70">tile</tspan></text>
"""

# opposite sides are equal: a knob above and below, a wave left and right
GOOD = "m 0,0 h 8 c -1,-2 -3,-3 -3,-5 a 5,4 0 0 1 10,0 c 0,2 -2,3 -3,5 h 8 c 4,6 -5,14 0,20 "
GOOD += "h -8 c 1,-2 3,-3 3,-5 a 5,4 0 0 0 -10,0 c 0,2 2,3 3,5 h -8 c -5,-6 4,-14 0,-20 z"
SQUARE = "m 0,0 h 20 v 20 h -20 z"


def drawing(tmp_path, body, page=A4):
    path = tmp_path / "tile.svg"
    path.write_text(f"{HEAD}{page}>\n{HIDDEN}{body}\n</svg>\n")
    return path


def layer(*paths, transform="translate(50,60)"):
    body = "".join(
        f'<path id="tile{k}" style="fill:none;stroke:#000" d="{d}"/>\n' for k, d in enumerate(paths)
    )
    return f'<g inkscape:groupmode="layer" id="layer1" transform="{transform}">{body}</g>'


def paths_of(unit, size, turn=0.4):
    """The tiles of a unit as paths."""
    c, s = size * np.cos(turn), size * np.sin(turn)
    tiles = [tile @ np.array([[c, -s], [-s, -c]]) for tile in outlines(unit)]
    return ["M " + " ".join(f"{x:.4f},{y:.4f}" for x, y in tile) + " Z" for tile in tiles]


def message(tmp_path, *arguments):
    with pytest.raises(OptionError) as caught:
        user_unit(drawing(tmp_path, *arguments))
    return str(caught.value)


def place(text):
    return [float(value) for value in re.search(r"\(([-0-9.]+), ([-0-9.]+)\)", text).groups()]


def test_curves_and_arcs_become_a_tiling(tmp_path):
    unit = user_unit(drawing(tmp_path, layer(GOOD)))
    check_unit(unit)
    assert (unit.n_tiles, len(unit.ends)) == (1, 2)
    assert unit.translations == pytest.approx(np.eye(2), abs=1e-4)
    assert (cover_counts(unit) == 1).all()
    assert locked_edges(unit).any()


@pytest.mark.parametrize(
    ("body", "page"),
    [
        (layer(GOOD, transform="matrix(2,0,0,2,-30,5)"), A4),
        (layer(GOOD, transform="translate(7) rotate(90) scale(0.3)"), A4),
        (
            f"<g transform='scale(3)'>{layer(GOOD, transform='rotate(90 4 5)')}</g>",
            'width="300" height="400"',
        ),
        (f'<defs><path id="d" d="{GOOD}"/></defs><use xlink:href="#d" x="30" y="9"/>', A4),
        (layer(GOOD), 'width="8in" height="4in" viewBox="-10 -20 800 400"'),
        (layer(GOOD.replace("z", "")), A4),
    ],
)
def test_units_transforms_and_copies_do_not_change_the_tiling(tmp_path, body, page):
    plain = user_unit(drawing(tmp_path, layer(GOOD)))
    other = user_unit(drawing(tmp_path, body, page))
    assert is_moved(outlines(plain)[0], outlines(other)[0], tolerance=2e-4)


@pytest.mark.parametrize(
    "name", ["macro", "hex", "isohedral:IH03", "isohedral:IH28", "isohedral:IH21", "isohedral:IH79"]
)
def test_tiles_of_a_known_tiling_are_recognised_from_their_outlines(tmp_path, name):
    """As they were: not mirrored either, though y points down in a file."""
    known = get_family(name)
    unit = user_unit(drawing(tmp_path, layer(*paths_of(known, 25.0))))
    assert (unit.n_tiles, len(unit.ends), len(unit.corners)) == (
        known.n_tiles,
        len(known.ends),
        len(known.corners),
    )
    assert all(is_moved(a, b, tolerance=2e-3) for a, b in zip(outlines(known), outlines(unit), strict=True))


def test_gaps_of_drawing_precision_are_snapped_shut(tmp_path):
    rng = np.random.default_rng(0)
    rough = [
        re.sub(r"-?\d+\.\d+", lambda number: f"{float(number[0]) + rng.uniform(-0.03, 0.03):.3f}", path)
        for path in paths_of(get_family("isohedral:IH61"), 25.0)
    ]
    unit = user_unit(drawing(tmp_path, layer(*rough)))
    check_unit(unit)
    assert (unit.n_tiles, len(unit.ends)) == (2, 4)
    assert (cover_counts(unit) == 1).all()


def test_bump_without_a_hollow_overlaps(tmp_path):
    said = message(tmp_path, layer("m 0,0 h 20 v 8 h 4 v 4 h -4 v 8 h -20 z"))
    assert "copies of path tile0 overlap" in said
    assert "3.8% of a tile" in said
    from_bump = np.array(place(said)) - [72, 70]
    assert from_bump - 20 * np.rint(from_bump / 20) == pytest.approx([0, 0], abs=2)


def test_hollow_without_a_bump_leaves_a_hole(tmp_path):
    said = message(tmp_path, layer("m 0,0 h 20 v 8 h -4 v 4 h 4 v 8 h -20 z"))
    assert "leave a hole" in said
    assert "4.2% of a tile" in said
    from_hollow = np.array(place(said)) - [68, 70]
    assert from_hollow - 20 * np.rint(from_hollow / 20) == pytest.approx([0, 0], abs=2)


def test_tiles_drawn_over_each_other_are_named(tmp_path):
    said = message(tmp_path, layer(SQUARE, "m 18,0 h 20 v 20 h -20 z"))
    assert "tile0" in said
    assert "overlap" in said


def test_round_tile_can_not_cover(tmp_path):
    said = message(tmp_path, '<circle cx="50" cy="50" r="10"/>')
    assert "overlap" in said or "hole" in said or "no two stretches" in said


def test_open_path_is_named_with_its_ends(tmp_path):
    said = message(tmp_path, layer("m 0,0 h 20 v 20 h -19"))
    assert "tile0 is open: it starts at (50, 60) and ends at (51, 80)" in said


def test_self_crossing_is_named_with_its_place(tmp_path):
    said = message(tmp_path, layer("m 0,0 l 20,20 v -20 l -20,20 z", transform="scale(2) translate(5,5)"))
    assert "tile0 crosses or touches itself" in said
    assert place(said) == pytest.approx([30, 30])


@pytest.mark.parametrize(
    "text",
    ["", "no picture", "<html/>", f'{HEAD}width="0" height="0" viewBox="0 0 9 9"></svg>', f"{HEAD}></svg>"],
)
def test_files_without_an_outline_are_refused(tmp_path, text):
    path = tmp_path / "other.svg"
    path.write_text(text)
    with pytest.raises(OptionError, match=r"other\.svg"):
        user_unit(path)


def test_missing_file_is_named():
    with pytest.raises(OptionError, match=r"no file nowhere\.svg"):
        user_unit("nowhere.svg")


@pytest.mark.parametrize("d", [SQUARE, "m 0,0 c 6,8 14,-8 20,0 v 20 c -6,-8 -14,8 -20,0 z"])
def test_tiles_that_can_be_pulled_apart_are_allowed_with_a_note(tmp_path, caplog, d):
    with caplog.at_level(logging.WARNING, "meshjig"):
        unit = user_unit(drawing(tmp_path, layer(d)))
    assert (cover_counts(unit) == 1).all()
    assert "don't interlock" in caplog.text


def test_tiles_that_lock_get_no_note(tmp_path, caplog):
    with caplog.at_level(logging.WARNING, "meshjig"):
        user_unit(drawing(tmp_path, layer(GOOD)))
    assert not caplog.messages
