import numpy as np
import pytest

from meshjig.output.pictures.colours import colours, oklab


def grid_neighbours(side):
    number = np.arange(side * side).reshape(side, side)
    return np.concatenate(
        [
            np.stack([a.ravel(), b.ravel()], 1)
            for a, b in [
                (number[1:], number[:-1]),
                (number[:, 1:], number[:, :-1]),
                (number[1:, 1:], number[:-1, :-1]),
            ]
        ]
    )


def distances(rgb, pairs):
    lab = oklab(rgb)
    return np.linalg.norm(lab[pairs[:, 0]] - lab[pairs[:, 1]], axis=1)


@pytest.mark.parametrize("n", [1, 2, 30, 1000])
def test_all_colours_differ_on_a_screen(n):
    rgb = colours(n)
    assert rgb.shape == (n, 3)
    assert rgb.min() >= 0
    assert rgb.max() <= 1
    assert len(np.unique(np.round(255 * rgb), axis=0)) == n


@pytest.mark.parametrize(
    "pairs",
    [
        grid_neighbours(25),
        np.stack(np.triu_indices(8, 1), 1),
        np.stack([np.zeros(40, int), np.arange(1, 41)], 1),
    ],
    ids=["grid", "all touch all", "one touches 40"],
)
def test_neighbours_differ_clearly(pairs):
    assert distances(colours(int(pairs.max()) + 1, pairs), pairs).min() > 0.1


def test_colours_are_neither_black_nor_white():
    lightness = oklab(colours(500))[:, 0]
    assert lightness.min() > 0.4
    assert lightness.max() < 0.95


def test_equal_input_gives_equal_colours():
    pairs = grid_neighbours(9)
    np.testing.assert_array_equal(colours(81, pairs), colours(81, pairs))


def test_oklab_of_white_and_grey():
    np.testing.assert_allclose(oklab(np.array([[1.0, 1, 1], [0, 0, 0]])), [[1, 0, 0], [0, 0, 0]], atol=1e-4)
