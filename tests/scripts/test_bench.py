"""The bench compares this checkout with another one."""

import subprocess
import sys

import pytest
import trimesh

from tests.docs.blocks import ROOT
from tests.meshes import sphere

BENCH = ROOT / "scripts" / "bench.py"


def bench(*words):
    command = [sys.executable, str(BENCH), *map(str, words)]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=False)


@pytest.mark.slow
def test_a_checkout_against_itself_costs_about_the_same(tmp_path):
    V, F = sphere(300)
    trimesh.Trimesh(V, F, process=False).export(tmp_path / "ball.ply")
    said = bench("against", ROOT, "--mesh", tmp_path / "ball.ply", "--runs", 1, "--pieces", 6)
    assert said.returncode == 0, said.stderr
    rows = [line.split() for line in said.stdout.splitlines() if line.startswith("  ")]
    assert [row[3] for row in rows] == ["s", "s", "MB"]
    for old, new, ratio, *_ in rows:
        assert float(ratio) == pytest.approx(float(new) / float(old), abs=0.02)
    assert 0.8 < float(rows[2][2]) < 1.25  # memory does not depend on what else the machine does
    assert float(rows[2][0]) > 50


def test_what_is_no_checkout_is_said(tmp_path):
    said = bench("against", "no-such-revision")
    assert said.returncode == 1
    assert "neither a checkout nor a revision" in said.stderr
    assert bench("against").returncode == 2
    assert bench("swiftness").returncode == 2
