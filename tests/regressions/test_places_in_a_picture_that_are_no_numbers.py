"""Places in a picture that are NaN once let warnings of NumPy through; warnings are errors in these tests."""

import numpy as np
import pytest
from PIL import Image

from meshjig import make_puzzle
from tests.meshes import sphere


@pytest.mark.parametrize("which", ["all", "some"])
def test_a_puzzle_is_made_without_a_warning(tmp_path, capfd, which):
    V, F = sphere(500)
    Image.new("RGB", (8, 8), (200, 10, 10)).save(tmp_path / "p.png")
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd p.png\n")
    uv = (
        np.full((len(V), 2), np.nan)
        if which == "all"
        else np.where(V[:, :1] > 0, np.nan, V[:, :2] / 200 + 0.5)
    )
    rows = ["mtllib m.mtl", "usemtl a", *(f"v {x} {y} {z}" for x, y, z in V), *(f"vt {u} {v}" for u, v in uv)]
    rows += ["f " + " ".join(f"{k}/{k}" for k in face) for face in F + 1]
    (tmp_path / "m.obj").write_text("\n".join(rows) + "\n")
    puzzle = make_puzzle(tmp_path / "m.obj", pieces=6)
    folder = puzzle.save(tmp_path / "out", ("3mf", "glb", "obj"), viewer=False, guide=False)
    assert (folder / "puzzle.glb").is_file()
    assert puzzle.report["ok"], puzzle.report["failures"]
    assert capfd.readouterr().err == ""
