"""A full TMPDIR once made a good 3MF file "damaged or cut off": reading writes nothing."""

import json
import os
import subprocess
import sys

import pytest

from tests.scan.files.three_mf.build import TETRAHEDRON, mesh, model, package


@pytest.mark.skipif(sys.platform != "linux", reason="files limited to no bytes")
def test_a_3mf_is_read_where_nothing_can_be_written(tmp_path):
    path = package(tmp_path / "a.3mf", model(mesh(1, V=10 * TETRAHEDRON)))
    words = [sys.executable, "-P", "-m", "meshjig", "info", str(path), "--json"]
    limit = "import os, resource; resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))"
    script = f"{limit}; os.execv({sys.executable!r}, {words!r})"
    env = os.environ | {"TMPDIR": str(tmp_path)}
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, env=env, check=False)
    assert ended.returncode == 0, ended.stderr
    facts = json.loads(ended.stdout)
    assert (facts["faces"], facts["size_mm"]) == (4, [100, 100, 100])
    assert [child.name for child in tmp_path.iterdir()] == ["a.3mf"]
