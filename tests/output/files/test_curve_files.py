import re
from xml.etree import ElementTree

import numpy as np
import pytest

from meshjig.output.files.curve_files import write_dxf, write_obj_lines, write_svg

SQUARE = np.array([[0.0, 0], [30, 0], [30, 20], [0, 20], [0, 0]])
ARC = np.array([[-5.0, 1], [2, 2.5], [8, -4]])
HELIX = np.stack([np.cos(np.arange(20.0)), np.sin(np.arange(20.0)), np.arange(20.0)], 1)
TRIANGLE = np.array([[0.0, 0, 1], [1, 0, 2], [0, 1, 3], [0, 0, 1]])


def test_svg_is_true_to_size_with_y_upward(tmp_path):
    write_svg(tmp_path / "cuts.svg", [SQUARE, ARC])
    root = ElementTree.parse(tmp_path / "cuts.svg").getroot()
    left, top, width, height = (float(x) for x in root.get("viewBox").split())
    assert root.get("width") == f"{width:.4f}mm"
    assert root.get("height") == f"{height:.4f}mm"
    assert left < -5
    assert left + width > 30
    assert top < -20
    assert top + height > 4
    paths = [p.get("d") for p in root.iter("{http://www.w3.org/2000/svg}path")]
    assert [d.endswith("Z") for d in paths] == [True, False]
    points = [
        np.array([float(x) for x in re.findall(r"-?\d+\.?\d*", d)]).reshape(-1, 2) * (1, -1) for d in paths
    ]
    np.testing.assert_allclose(points[0], SQUARE[:-1])
    np.testing.assert_allclose(points[1], ARC)


def test_obj_lines_keep_points_and_close(tmp_path):
    write_obj_lines(tmp_path / "cuts.obj", [HELIX, TRIANGLE])
    lines = (tmp_path / "cuts.obj").read_text().splitlines()
    V = np.array([[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")])
    runs = [[int(x) - 1 for x in line.split()[1:]] for line in lines if line.startswith("l ")]
    np.testing.assert_allclose(V[runs[0]], HELIX, atol=1e-7)
    np.testing.assert_allclose(V[runs[1]], TRIANGLE)
    assert len(V) == 20 + 3


def test_dxf_has_a_polyline_a_curve(tmp_path):
    write_dxf(tmp_path / "cuts.dxf", [HELIX, TRIANGLE, ARC])
    lines = (tmp_path / "cuts.dxf").read_text().splitlines()
    tags = list(zip(map(int, lines[::2]), lines[1::2], strict=True))
    assert tags[-1] == (0, "EOF")
    assert (9, "$ACADVER") in tags
    curves, flags = [], []
    for k, (code, value) in enumerate(tags):
        if (code, value) == (0, "POLYLINE"):
            curves.append([])
            flags.append(int(next(v for c, v in tags[k:] if c == 70)))
        if (code, value) == (0, "VERTEX"):
            curves[-1].append([float(next(v for c, v in tags[k:] if c == axis)) for axis in (10, 20, 30)])
    assert flags == [8, 9, 8]
    np.testing.assert_allclose(curves[0], HELIX, atol=1e-7)
    np.testing.assert_allclose(curves[1], TRIANGLE[:-1])
    np.testing.assert_allclose(curves[2], np.column_stack([ARC, np.zeros(3)]))


@pytest.mark.parametrize("write", [write_svg, write_obj_lines, write_dxf])
def test_no_curves_give_a_file_with_none(tmp_path, write):
    write(tmp_path / "none", [])
    assert (tmp_path / "none").read_text()
