"""Copies of a unit cover a box with every corner, edge and tile once."""

import numpy as np
import pytest
import shapely

from meshjig.mesh.types import UV_GRID
from meshjig.tiling import Placing, squares
from meshjig.tiling.fit import bent_round
from meshjig.tiling.net import lay_net
from meshjig.tiling.template import classic
from tests.tiling.units import bricks, waves

UNITS = {"squares": squares(classic), "bricks": bricks(), "waves": waves()}
BOX = np.array([-7.0, 11.0, 60.0, 45.0])


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_neighbouring_copies_share_their_corners_and_edges(name, angle):
    net = lay_net(UNITS[name], Placing(8.0, angle, np.array([3.0, -2.0])), BOX, 0.0)
    assert len(np.unique(np.rint(net.nodes / 1e-3), axis=0)) == len(net.nodes)
    assert len(np.unique(np.sort(net.ends, axis=1), axis=0)) == len(net.ends)
    np.testing.assert_array_equal(net.first_edge, np.arange(len(net.ends)))
    np.testing.assert_array_equal(net.first_node, np.arange(len(net.nodes)))


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_edges_divide_the_box_into_the_tiles_on_their_sides(name, angle):
    net = lay_net(UNITS[name], Placing(8.0, angle, np.array([3.0, -2.0])), BOX, 12.0)
    ends = net.nodes[net.ends]
    cells = shapely.get_parts(shapely.polygonize(shapely.linestrings(ends)))
    cells = cells[shapely.intersects(cells, shapely.box(*BOX))]
    assert shapely.area(shapely.intersection(cells, shapely.box(*BOX))).sum() == pytest.approx(67.0 * 34.0)
    np.testing.assert_allclose(shapely.area(cells), 64.0, rtol=1e-4)
    normal = np.stack([ends[:, 0, 1] - ends[:, 1, 1], ends[:, 1, 0] - ends[:, 0, 0]], 1) * 1e-3
    tree, owner = shapely.STRtree(cells), {}
    for side, tile in ((normal, net.left), (-normal, net.right)):
        edge, cell = tree.query(shapely.points(ends.mean(1) + side), predicate="within")
        for e, c in zip(edge.tolist(), cell.tolist(), strict=True):
            assert owner.setdefault(c, int(tile[e])) == tile[e]
    assert len(owner) == len(set(owner.values())) == len(cells)


@pytest.mark.parametrize("name", sorted(UNITS))
@pytest.mark.parametrize("period", [40.0, 71.5])
def test_a_net_bent_round_repeats_exactly_after_the_period(name, period):
    for placing in bent_round(UNITS[name], 8.0, period):
        net = lay_net(UNITS[name], placing, np.array([0.0, 0.0, 1.6 * period, 30.0]), 4.0)
        whole = net.nodes / UV_GRID
        np.testing.assert_array_equal(whole, np.rint(whole))
        off = net.nodes - net.nodes[net.first_node]
        assert not off[:, 1].any()
        np.testing.assert_array_equal(off[:, 0] % period, 0)
        assert off[:, 0].any()
        ends = net.nodes[net.ends] - net.nodes[net.ends[net.first_edge]]
        np.testing.assert_array_equal(ends[..., 0], np.repeat(net.turns[:, None] * period, 2, axis=1))
        np.testing.assert_array_equal(net.left, net.left[net.first_edge])
        np.testing.assert_array_equal(net.kind, net.kind[net.first_edge])
        assert np.diff(np.unique(net.nodes[net.first_node[net.ends]], axis=0), axis=0).any()
