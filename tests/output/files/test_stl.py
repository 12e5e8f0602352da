import struct

import numpy as np
import trimesh

from meshjig.output.files.stl import write_stl
from tests.meshes import genus2


def test_stl_holds_every_face_in_order(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F, "piece_007")
    content = (tmp_path / "a.stl").read_bytes()
    assert len(content) == 84 + 50 * len(F)
    assert struct.unpack("<I", content[80:84]) == (len(F),)
    numbers = struct.unpack("<12fH", content[84 + 50 * 41 : 84 + 50 * 42])
    np.testing.assert_array_equal(np.reshape(numbers[3:12], (3, 3)), V[F[41]].astype("f4"))
    read = trimesh.load_mesh(tmp_path / "a.stl")
    assert read.is_watertight
    np.testing.assert_allclose(read.triangles, V[F], atol=1e-5)


def test_normals_point_outward(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F)
    raw = np.frombuffer((tmp_path / "a.stl").read_bytes()[84:], "V50").view(
        [("normal", "<f4", 3), ("rest", "V38")]
    )
    np.testing.assert_allclose(raw["normal"], trimesh.Trimesh(V, F, process=False).face_normals, atol=1e-4)


def test_header_tells_maker_name_and_unit_and_does_not_look_like_ascii(tmp_path):
    V, F = genus2(700)
    write_stl(tmp_path / "a.stl", V, F, "piece_007" + 90 * "x")
    header = (tmp_path / "a.stl").read_bytes()[:80]
    assert b"meshjig" in header
    assert b"mm" in header
    assert b"piece_007" in header
    assert not header.lower().startswith(b"solid")
