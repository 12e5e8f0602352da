"""Area counts where it is stretched within limits, and nothing counts where some is beyond use."""

import numpy as np
import pytest

from meshjig.charts.distortion import share_within_limits, usable_share


@pytest.mark.parametrize(
    ("stretch", "good"),
    [
        ((1.0, 1.0), True),
        ((1.24, 0.81), True),
        ((1.26, 1.0), False),
        ((1.0, 0.79), False),
        ((1.0, -1.0), False),
    ],
)
def test_both_stretches_have_to_be_within_limits(stretch, good):
    area = np.array([3.0, 1.0])
    assert share_within_limits(area, np.array([stretch, (2.0, 1.0)])) == (0.75 if good else 0.0)


def test_a_little_may_be_beyond_use_but_not_more():
    stretch = np.array([(1.0, 1.0), (3.0, 1.0)])
    assert usable_share(np.array([0.996, 0.004]), stretch) == pytest.approx(0.996)
    assert usable_share(np.array([0.99, 0.01]), stretch) == 0.0
