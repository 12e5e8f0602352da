"""Arrays of a glTF file are read as they are meant: strided, normalised, sparse."""

import numpy as np
import pytest

from meshjig.scan.files.gltf.accessors import read_accessor, read_floats
from meshjig.scan.files.gltf.container import open_gltf
from tests.scan.files.gltf.build import Build


def opened(build, tmp_path):
    return open_gltf(build.glb(tmp_path / "a.glb"))


def test_entries_may_lie_apart_and_start_later(tmp_path):
    build = Build()
    rows = np.arange(20, dtype="f4").reshape(4, 5)
    view = build.view(rows.tobytes(), byteStride=20)
    build.accessor({"bufferView": view, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC3"})
    np.testing.assert_array_equal(read_accessor(opened(build, tmp_path), 0), rows[:, 1:4])


@pytest.mark.parametrize(
    ("values", "real"),
    [
        (np.array([0, 51, 255], "u1"), [0, 0.2, 1]),
        (np.array([0, 13107, 65535], "u2"), [0, 0.2, 1]),
        (np.array([-128, -127, 127], "i1"), [-1, -1, 1]),
        (np.array([-32768, -32767, 32767], "i2"), [-1, -1, 1]),
    ],
)
def test_whole_numbers_that_are_normalised_stand_for_real_ones(tmp_path, values, real):
    build = Build()
    build.array(values, normalized=True)
    build.array(values)
    file = opened(build, tmp_path)
    np.testing.assert_allclose(read_floats(file, 0)[:, 0], real)
    np.testing.assert_array_equal(read_floats(file, 1)[:, 0], values)


@pytest.mark.parametrize("based", [True, False])
def test_sparse_entries_replace_those_below(tmp_path, based):
    build = Build()
    below = np.full((5, 3), 7, "f4") if based else np.zeros((5, 3), "f4")
    number = build.array(below)
    if not based:
        del build.header["accessors"][number]["bufferView"]
    build.header["accessors"][number]["sparse"] = {
        "count": 2,
        "indices": {"bufferView": build.view(np.array([1, 4], "u2").tobytes()), "componentType": 5123},
        "values": {"bufferView": build.view(np.array([[1, 2, 3], [4, 5, 6]], "f4").tobytes())},
    }
    below[[1, 4]] = [[1, 2, 3], [4, 5, 6]]
    np.testing.assert_array_equal(read_accessor(opened(build, tmp_path), number), below)


@pytest.mark.parametrize("wrong", [{"count": 6}, {"byteOffset": 8}, {"count": -1}, {"bufferView": 5}])
def test_what_ends_beyond_its_bytes_is_refused(tmp_path, wrong):
    build = Build()
    build.array(np.zeros((5, 3), "f4"), **wrong)
    with pytest.raises(ValueError, match=r"beyond|less|no number"):
        read_accessor(opened(build, tmp_path), 0)
