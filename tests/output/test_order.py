import numpy as np
import pytest

from meshjig.output.order import assembly_of, assembly_order, ways_out
from meshjig.output.piece import Piece
from tests.meshes import moved, sphere


def stack(places):
    return [
        Piece(f"piece_{k + 1:03d}", *moved(sphere(80, 5.0), place), (0.5, 0.5, 0.5))
        for k, place in enumerate(np.asarray(places, float).tolist())
    ]


def tower(n_around=8, n_up=10, seed=0):
    """Give a shuffled tower of rings of pieces, y upward, and who touches whom."""
    turn, level = np.meshgrid(np.arange(n_around), np.arange(n_up), indexing="ij")
    angle = 2 * np.pi * turn.ravel() / n_around
    height = 12.0 * level.ravel() + 3.0 * np.cos(angle)
    places = np.stack([30 * np.cos(angle), height, 30 * np.sin(angle)], 1)
    order = np.random.default_rng(seed).permutation(len(places))
    where = np.argsort(order).reshape(n_around, n_up)
    neighbours = [[] for _ in places]
    for a, b in [(where, np.roll(where, 1, 0)), (where[:, 1:], where[:, :-1])]:
        for i, j in zip(a.ravel().tolist(), b.ravel().tolist(), strict=True):
            neighbours[i].append(j + 1)
            neighbours[j].append(i + 1)
    return places[order], neighbours


@pytest.mark.parametrize("seed", range(3))
def test_next_is_always_the_lowest_of_those_that_touch_what_is_placed(seed):
    places, neighbours = tower(seed=seed)
    row = [piece for step in assembly_order(stack(places), neighbours) for piece in step]
    height = places[:, 1]
    assert height[row[0] - 1] == height.min()
    placed = {row[0]}
    for piece in row[1:]:
        open_to = {near for one in placed for near in neighbours[one - 1]} - placed
        assert piece in open_to
        assert height[piece - 1] == pytest.approx(min(height[one - 1] for one in open_to))
        placed.add(piece)
    assert placed == set(range(1, len(places) + 1))


@pytest.mark.parametrize("n", [1, 2, 30, 31, 100])
def test_every_piece_comes_once_in_at_most_thirty_steps_of_the_same_size(n):
    steps = assembly_order(stack([[12 * k, k, 0] for k in range(n)]), [[]] * n)
    assert sorted(piece for step in steps for piece in step) == list(range(1, n + 1))
    assert len(steps) <= 30
    assert len({len(step) for step in steps[:-1]}) <= 1
    assert 1 <= len(steps[-1]) <= len(steps[0])


def test_a_second_heap_begins_once_the_first_is_done():
    pieces = stack([[0, 0, 0], [0, 20, 0], [90, 5, 0], [90, 30, 0]])
    steps = assembly_order(pieces, [[2], [1], [4], [3]])
    assert [piece for step in steps for piece in step] == [1, 2, 3, 4]


def test_no_pieces_no_steps():
    assert assembly_order([], []) == []


def test_a_plan_in_the_report_wins_and_says_whether_it_is_verified():
    pieces = stack([[0, 0, 0], [0, 20, 0], [0, 40, 0]])
    report = {"pieces": [{"neighbours": [2]}, {"neighbours": [1, 3]}, {"neighbours": [2]}]}
    assert assembly_of(pieces, report) == ([[1], [2], [3]], False)
    assert assembly_of(pieces, {**report, "assembly": {"steps": [[3], [1, 2]]}}) == ([[3], [1, 2]], False)
    planned = {"steps": [[3, 2], [1]], "verified": True}
    assert assembly_of(pieces, {**report, "assembly": planned}) == ([[3, 2], [1]], True)
    assert sorted(piece for step in assembly_of(pieces, {}).steps for piece in step) == [1, 2, 3]


def test_the_order_goes_the_way_that_the_report_says_is_up():
    pieces = stack([[0, 0, 0], [12, 2, 1], [24, 1, 2]])
    assert assembly_of(pieces, {"up": [-1, 0, 0]}).steps == [[3], [2], [1]]
    assert assembly_of(pieces, {"up": [0, 1, 0]}).steps == [[1], [3], [2]]


@pytest.mark.parametrize("n", [1, 30, 31, 60, 100])
def test_a_plan_of_one_piece_a_step_is_told_in_thirty_steps_at_most(n):
    pieces = stack([[12 * k, 0, 0] for k in range(3)])
    steps = assembly_of(pieces, {"assembly": {"steps": [[k + 1] for k in range(n)]}}).steps
    assert [piece for step in steps for piece in step] == list(range(1, n + 1))
    assert len(steps) <= 30
    assert max(map(len, steps)) == -(-n // 30)


def test_ways_out_are_unit_and_zero_where_a_piece_has_none():
    motions = {"1": {"axis": [0, 3, 0]}, "2": {"axis": None}, "4": {"axis": [1, 1, 0]}}
    ways = ways_out({"assembly": {"steps": [[1, 2, 3, 4]], "motions": motions}}, 4)
    assert ways == pytest.approx(np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0], [0.5**0.5, 0.5**0.5, 0]]))


@pytest.mark.parametrize("report", [{}, {"assembly": None}, {"assembly": {"steps": [[1]], "verified": True}}])
def test_a_report_without_motions_has_no_ways(report):
    assert ways_out(report, 1) is None
