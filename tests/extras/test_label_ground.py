"""Labels stand where they can be read in the hand, and are hidden once the puzzle is put together."""

import numpy as np
import pytest

from meshjig.extras.engrave import LETTERING, engrave
from meshjig.extras.label_ground import label_grounds
from meshjig.mesh.booleans import arrays, body
from meshjig.mesh.mesh import Mesh, concatenate

SLA = LETTERING["sla"]
GAP = 0.2


def box(low, high):
    import manifold3d

    size = np.subtract(high, low).tolist()
    return arrays(manifold3d.Manifold.cube(size).translate(list(low)).refine_to_length(1.5))


def slab(thick, beside=1):
    """A plate that two pieces share, both reaching through; the sheets of the whole plate, 1 mm apart."""
    whole = Mesh(*box([-20, -10, 0], [20, 10, thick]))
    D = -0.5 * np.sign(whole.V - whole.V.mean(axis=0))
    halves = [box([-20, -10, 0], [-GAP / 2, 10, thick]), box([GAP / 2, -10, 0], [20, 10, thick])]
    return halves[: 1 + beside], whole, D


def faces_towards(V, F, axis):
    N = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return (N @ np.array(axis) > 0.9 * np.linalg.norm(N, axis=1)).nonzero()[0]


def test_a_piece_seen_from_both_sides_has_its_label_on_the_wall_between_pieces():
    halves, whole, D = slab(6.0)
    grounds = label_grounds(halves, whole, D, np.full(2, 8.0))
    for (V, F), (inner, side), toward in zip(halves, grounds, ([1, 0, 0], [-1, 0, 0]), strict=True):
        assert not inner.any()
        assert set(side.nonzero()[0]) == set(faces_towards(V, F, toward))
        assert np.allclose(side[side > 0], 20 - GAP / 2, atol=1e-3)
    made, facts = engrave(halves, ["3", "4"], grounds, SLA, min_wall=0.8)
    assert (facts.engraved, facts.on_walls, facts.skipped) == (2, ("3", "4"), {})
    for (V, _), (W, _) in zip(made, halves, strict=True):
        new = V[(np.abs(V[:, None] - W).max(axis=2) > 1e-9).all(axis=1)]
        assert np.abs(new[:, 0]).max() < GAP / 2 + 0.31  # as deep as text is
        assert 0.3 < new[:, 2].min() < new[:, 2].max() < 5.7  # away from both sides


def test_a_low_wall_has_no_room_and_that_is_said():
    halves, whole, D = slab(2.0)
    made, facts = engrave(halves, ["3", "4"], label_grounds(halves, whole, D, np.full(2, 6.0)), SLA)
    assert facts.engraved == 0
    assert all("reaches through" in why for why in facts.skipped.values())
    assert all(np.array_equal(new[0], old[0]) for new, old in zip(made, halves, strict=True))


def test_the_rim_of_a_model_is_seen_and_stays_as_it_is():
    [alone], whole, D = slab(6.0, beside=0)
    _, facts = engrave([alone], ["3"], label_grounds([alone], whole, D, np.array([8.0])), SLA)
    assert facts.engraved == 0


@pytest.mark.parametrize(("hollow", "readable"), [(1.5, False), (9.0, True)])
def test_nothing_stands_in_a_narrow_hollow_of_the_piece_itself(hollow, readable):
    """A clip of two skins: its inner sides look at each other."""
    skin, half = 2.0, hollow / 2
    clip = body(*box([-12, -12, -half - skin], [12, 12, half + skin])) - body(
        *box([-9, -13, -half], [13, 13, half])
    )
    top = half + skin
    upper = np.array([[-12, -12, top], [12, -12, top], [12, 12, top], [-12, 12, top]])
    turn = np.array([[0, 1, 2], [0, 2, 3]])
    outer = concatenate([Mesh(upper, turn), Mesh(upper * [1, 1, -1], turn[:, ::-1])])
    D = np.sign(outer.V[:, 2:]) * np.array([0, 0, -skin])
    piece = arrays(clip)
    [ground] = label_grounds([piece], Mesh(outer.V, outer.F), D, np.array([4.0]))
    assert ground.inner.any() == readable
    _, facts = engrave([piece], ["5"], [ground], SLA, min_wall=0.8)
    assert facts.engraved == readable
    assert facts.on_walls == ()
