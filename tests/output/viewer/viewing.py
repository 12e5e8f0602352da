"""Puzzles to look at in a browser, and how to tell what is seen there."""

import json

import numpy as np
import pytest

from meshjig.mesh.measure import unit
from meshjig.output.piece import Piece
from tests.meshes import moved, sphere
from tests.output.viewer.browser import find_browser

__all__ = [
    "BIG",
    "HUES",
    "click_on",
    "hue_of",
    "needs_browser",
    "opened",
    "pixels_of",
    "report_of",
    "ring",
    "seen",
    "shown",
    "text",
]

needs_browser = pytest.mark.skipif(find_browser() is None, reason="no Chromium is installed")

HUES = [(0.9, 0.1, 0.1), (0.8, 0.8, 0.1), (0.1, 0.8, 0.1), (0.1, 0.8, 0.8), (0.1, 0.1, 0.9), (0.8, 0.1, 0.8)]
BIG = 4  # the piece that is larger than all others, counted from 1


def ring():
    """Give six spheres that nearly touch, as a standing wheel that faces the viewer's first look."""
    angle = 2 * np.pi * np.arange(6) / 6
    right, up = np.array([np.cos(np.pi / 6), 0, -np.sin(np.pi / 6)]), np.array([0, 1, 0])
    return [
        Piece(
            f"piece_{k + 1:03d}",
            *moved(
                sphere(500, 26.0 if k + 1 == BIG else 24.8),
                50 * (np.cos(a) * right + np.sin(a) * up),
            ),
            HUES[k],
        )
        for k, a in enumerate(angle)
    ]


def report_of(pieces, title="wheel.obj"):
    n = len(pieces)
    return {
        "input": {"file": f"/scans/{title}"},
        "pieces": [
            {
                "id": k + 1,
                "area_mm2": 900.0 if k + 1 == BIG else 400.0,
                "neighbours": sorted({(k - 1) % n + 1, (k + 1) % n + 1}),
            }
            for k in range(n)
        ],
    }


def opened(browser, path):
    browser.said.clear()
    browser.open(path)
    browser.wait_for("document.documentElement?.dataset.readyAfter")
    browser.settle()
    return browser


def shown(page):
    """Give the part of the picture that shows the model."""
    page.settle()
    box = json.loads(page.value("JSON.stringify($('view').getBoundingClientRect())"))
    left, top, right, bottom = (round(box[side]) for side in ("left", "top", "right", "bottom"))
    return page.picture()[top:bottom, left:right], (left, top)


def hue_of(picture):
    """Give for each pixel the piece whose hue it has, counted from 1, or 0 for the ground."""
    rgb = picture.astype(float)
    colourful = np.ptp(rgb, axis=2) > 70
    likeness = unit(rgb - rgb.mean(2, keepdims=True)) @ unit(np.array(HUES) - np.mean(HUES, 1)[:, None]).T
    return np.where(colourful & (likeness.max(2) > 0.9), likeness.argmax(2) + 1, 0)


def pixels_of(page):
    return np.bincount(hue_of(shown(page)[0]).ravel(), minlength=7)[1:]


def seen(page):
    """Give the pieces that can be seen, as the page itself finds out where to put numbers."""
    return {int(k) for k in page.value("[...new Set(window.viewer.stage.ids(300, 240))]")} - {0}


def text(page, name):
    return page.value(f"$('{name}').innerText")


def click_on(page, piece):
    picture, (left, top) = shown(page)
    row, column = np.argwhere(hue_of(picture) == piece).mean(0)
    page.click(left + column, top + row)
