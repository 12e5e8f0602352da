"""Girths alone tell how many rings and caps a tube needs."""

from itertools import pairwise

import numpy as np
import pytest

from meshjig.charts.tubes.harmonic_function import Girths
from meshjig.charts.tubes.tube_decomposition import Band, decompose_tube

OPEN, CLOSED, VASE = (False, False), (True, True), (True, False)


def tube(*radii, length=100.0, n=100):
    """Slices of equal length, their radius interpolated."""
    girth = 2 * np.pi * np.interp(np.linspace(0, 1, n), np.linspace(0, 1, len(radii)), radii)
    return Girths(np.linspace(0, 1, n + 1), girth * length / n, girth)


def dome_and_tube(radius=10.0, length=80.0, n=100):
    """A half sphere on a straight tube, sliced along the way from its tip."""
    way = np.linspace(0, np.pi / 2 * radius + length, n + 1)
    middle = (way[1:] + way[:-1]) / 2
    girth = 2 * np.pi * radius * np.sin(np.minimum(middle / radius, np.pi / 2))
    return Girths(way / way[-1], girth * np.diff(way), girth)


def kinds(bands):
    return [band.kind for band in bands]


@pytest.mark.parametrize(
    ("radii", "rings"),
    [((10, 10), 1), ((10, 15), 1), ((10, 14, 10), 1), ((10, 20), 2), ((10, 20, 10), 3), ((9, 30), 3)],
)
def test_rings_are_as_few_as_the_girths_allow(radii, rings):
    bands = decompose_tube(tube(*radii), OPEN, [])
    assert kinds(bands) == ["ring"] * rings


def test_bands_follow_each_other_from_end_to_end():
    slices = tube(10, 20, 10, 25)
    bands = decompose_tube(slices, OPEN, [])
    assert bands[0].start == 0
    assert bands[-1].stop == 100
    assert all(a.stop == b.start for a, b in pairwise(bands))


def test_girths_in_a_ring_keep_within_limits_but_for_a_little():
    slices = tube(10, 24, 8, 30)
    for band in decompose_tube(slices, OPEN, []):
        girth, area = (x[band.start : band.stop] for x in (slices.girth, slices.area))
        best = max(area[(girth >= g) & (girth <= g * 1.25 / 0.8)].sum() for g in girth)
        assert best >= 0.88 * area.sum()


def test_a_closed_end_gets_a_cap_that_ends_on_the_dome():
    slices = dome_and_tube()
    bands = decompose_tube(slices, VASE, [])
    assert kinds(bands) == ["cap", "ring"]
    assert slices.area[: bands[0].stop].sum() < 1.1 * 2 * np.pi * 10**2
    assert slices.girth[bands[0].stop] > slices.girth.max() * 0.8 / 1.25
    turned = Girths(slices.level, slices.area[::-1], slices.girth[::-1])
    assert kinds(decompose_tube(turned, (False, True), [])) == ["ring", "cap"]


def test_what_was_refused_is_not_proposed_again():
    slices = tube(10, 14, 10)
    whole = decompose_tube(slices, OPEN, [])
    again = decompose_tube(slices, OPEN, whole)
    assert len(again) > 1
    assert not set(again) & set(whole)
    assert max(band.stop - band.start for band in again) < 85


def test_an_end_that_is_no_cap_is_left_over():
    refused = [Band("cap", 0, k) for k in range(1, 101)]
    bands = decompose_tube(dome_and_tube(), VASE, refused)
    assert kinds(bands) == ["rest", "ring"]


def test_nothing_is_proposed_where_all_was_refused():
    refused = [Band("ring", k, k + 1) for k in range(100)]
    assert decompose_tube(tube(10, 10), OPEN, refused) == []
