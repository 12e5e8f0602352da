import json

import numpy as np
import pytest
import shapely
import shapely.affinity

from meshjig.check import is_closed_as_stl, is_one_component
from meshjig.mesh.measure import mesh_volume
from meshjig.options import PROCESSES, Options
from meshjig.output.files.read_pieces import read_pieces
from meshjig.pipeline.coupon import coupon_clearances, make_coupon, save_coupon


@pytest.fixture(scope="module", params=list(PROCESSES))
def coupon(request):
    options = Options.of(process=request.param)
    return options, make_coupon(options)


def floors(pieces):
    """What stands on the plate; that side has no engraving."""
    triangles = [piece.V[piece.F[(piece.V[piece.F, 2] == 0).all(axis=1)]][..., :2] for piece in pieces]
    return [shapely.union_all(shapely.polygons(corners)) for corners in triangles]


def test_every_tile_is_one_closed_solid_of_the_processs_thickness(coupon):
    options, pieces = coupon
    for piece in pieces:
        assert is_closed_as_stl(piece.V, piece.F)
        assert is_one_component(piece.F)
        assert piece.V[:, 2].min() == 0
        assert piece.V[:, 2].max() == pytest.approx(options.thickness, abs=1e-5)


def test_pairs_put_together_leave_exactly_their_clearance(coupon):
    _, pieces = coupon
    outlines = floors(pieces)
    for k in range(0, len(pieces), 2):
        gap = float(pieces[k].name.split("_")[1])
        male, female = outlines[k], outlines[k + 1]
        # together they fill a rectangle twice as wide as high, but for the gap
        left, low, _, high = male.bounds
        shift = left + 2 * (high - low) - female.bounds[2]
        female = shapely.affinity.translate(female, shift, 0)
        assert male.distance(female) == pytest.approx(gap, abs=0.001)
        knob = male.exterior.intersection(shapely.box(left + 0.9 * (high - low), low + 1, 1e3, high - 1))
        points = [knob.interpolate(t, normalized=True) for t in np.linspace(0, 1, 200)]
        assert max(female.distance(point) for point in points) == pytest.approx(gap, abs=0.01)


def test_no_knob_slips_through_its_neck_and_none_is_narrower_than_the_process_prints(coupon):
    options, pieces = coupon
    for male in floors(pieces)[::2]:
        left, low, right, high = male.bounds
        across = [
            male.intersection(shapely.box(x, low, x + 0.01, high)).area / 0.01
            for x in np.linspace(left + high - low + 0.3, right - 0.3, 60)
        ]
        neck = int(np.argmin(across[:30]))
        assert across[neck] >= options.min_neck - 0.02
        assert max(across[neck:]) > 1.5 * across[neck]


def test_tiles_lie_apart(coupon):
    outlines = floors(coupon[1])
    assert min(a.distance(b) for i, a in enumerate(outlines) for b in outlines[:i]) > 4


def test_the_clearance_is_engraved_in_the_upper_side_only(coupon):
    options, pieces = coupon
    for piece, outline in zip(pieces, floors(pieces), strict=True):
        missing = outline.area * options.thickness - mesh_volume(piece.V, piece.F)
        assert missing > 10 * 0.3 * options.thickness  # mm2 of text times its depth
        depths = np.unique(piece.V[:, 2].round(4))
        np.testing.assert_allclose(depths, np.array([0, 0.7, 1]) * options.thickness, atol=1e-3)


@pytest.mark.parametrize("clearance", [0.0, 0.02, 0.15, 0.2, 1.0])
def test_clearances_rise_through_the_processs_own(clearance):
    tried = coupon_clearances(clearance)
    assert len(tried) >= 4
    assert (np.diff(tried) >= 0.01 - 1e-9).all()
    assert min(tried) > 0
    assert clearance in tried or clearance == 0
    assert coupon_clearances(0.2) == [0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4]


def test_a_saved_coupon_is_read_back_and_says_how_to_use_it(tmp_path):
    report = save_coupon(tmp_path / "c", Options.of(process="sla"))
    written = json.loads((tmp_path / "c" / "report.json").read_text())
    assert written["how_to"] == report["how_to"]
    assert "--clearance" in written["how_to"]
    names = [piece["name"] for piece in written["pieces"]]
    assert sorted(name for name, _, _ in read_pieces(tmp_path / "c")) == sorted(names)
    assert [name for name, _, _ in read_pieces(tmp_path / "c" / "coupon.3mf")] == names
    assert (tmp_path / "c" / "preview.png").stat().st_size > 10_000
    save_coupon(tmp_path / "c", Options.of(process="fdm"))  # its own folder may be replaced
