"""What a file will take is told from its head and its size."""

import logging
import subprocess
import sys

import numpy as np
import pytest
import trimesh

from meshjig.errors import ResourceError
from meshjig.scan.forecast import foresee, foretell
from tests.meshes import sphere

MESH = sphere(20_000)


@pytest.mark.parametrize(("kind", "off_by"), [("stl", 0), ("ply", 0), ("off", 0), ("obj", 0.05)])
def test_faces_are_known_before_the_file_is_read(tmp_path, kind, off_by):
    path = _written(tmp_path, kind)
    assert foresee(path).faces == pytest.approx(len(MESH.F), rel=off_by)


def test_faces_of_a_text_stl_are_guessed(tmp_path):
    path = tmp_path / "scan.stl"
    path.write_text(trimesh.exchange.stl.export_stl_ascii(trimesh.Trimesh(*MESH, process=False)))
    assert foresee(path).faces == pytest.approx(len(MESH.F), rel=0.3)


def test_polygons_of_an_obj_count_as_their_triangles(tmp_path):
    path = tmp_path / "scan.obj"
    path.write_text("v 0 0 0\n" * 5 + "f 1 2 3 4 5\n" * 1000)
    assert foresee(path).faces == pytest.approx(3000, rel=0.05)


@pytest.mark.parametrize("bytes_", [b"", b"ply\n", b"OFF\n", b"\0" * 40])
def test_nothing_is_said_of_what_is_no_mesh(tmp_path, bytes_):
    for kind in ("ply", "off", "stl", "glb"):
        path = tmp_path / f"scan.{kind}"
        path.write_bytes(bytes_)
        assert foresee(path) is None
    assert foresee(tmp_path / "none.ply") is None


def test_more_than_may_be_taken_is_refused_before_it_is_loaded(tmp_path):
    with pytest.raises(ResourceError, match=r"GB of memory to be read, more than the 0.1 GB"):
        foretell(_written(tmp_path, "ply"), 0.1)
    foretell(_written(tmp_path, "ply"), 4.0)
    foretell(tuple(MESH), 0.1)


@pytest.mark.parametrize(("faces", "lines"), [(499_999, 0), (2_000_000, 1)])
def test_a_large_file_is_spoken_of(tmp_path, caplog, faces, lines):
    path = tmp_path / "scan.ply"
    path.write_bytes(b"ply\nformat ascii 1.0\nelement face %d\nend_header\n" % faces)
    with caplog.at_level(logging.INFO, "meshjig.told"):
        foretell(path)
    assert len(caplog.messages) == lines
    assert all("2,000,000 faces: about" in line and "GB of memory" in line for line in caplog.messages)


def test_the_command_ends_with_its_exit_code(tmp_path):
    run = _run("info", str(_written(tmp_path, "ply")), "--memory", "0.1")
    assert run.returncode == 5
    assert run.stderr.count("\n") == 1
    assert "more than the 0.1 GB of --memory" in run.stderr


def test_too_little_address_space_is_named():
    resource = pytest.importorskip("resource")
    run = _run(
        "info", "none.stl", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (4 * 10**8,) * 2)
    )
    assert run.returncode == 5
    assert "only 0.4 GB of address space are allowed" in run.stderr


def _written(folder, kind):
    path = folder / f"scan.{kind}"
    trimesh.Trimesh(np.asarray(MESH.V), MESH.F, process=False).export(path)
    return path


def _run(*words, **how):
    command = [sys.executable, "-m", "meshjig", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, **how)
