"""Scans fetched from elsewhere, with what they name; puzzles put elsewhere, whole or not to be seen."""

import json
import os
import uuid

import pytest
import trimesh

from meshjig.errors import ResourceError
from meshjig.fleet import places
from meshjig.fleet.make_scan import make_scan
from meshjig.fleet.named_files import names_in, with_named_files
from meshjig.fleet.places import below, fetch, file_name, pull_folder, push_folder, reach
from tests.fleet.scans import task
from tests.meshes import sphere

fsspec = pytest.importorskip("fsspec")


@pytest.fixture
def bucket():
    name = uuid.uuid4().hex
    files = fsspec.filesystem("memory")
    files.makedirs(f"/{name}")
    yield f"memory://{name}"
    files.rm(f"/{name}", recursive=True)


def put(bucket, **contents):
    files = fsspec.filesystem("memory")
    for name, data in contents.items():
        files.pipe(f"/{bucket.removeprefix('memory://')}/{name}", data)


def listed(bucket):
    root = "/" + bucket.removeprefix("memory://") + "/"
    return {path.removeprefix(root) for path in fsspec.filesystem("memory").find(root)}


def test_what_a_mesh_names_comes_along(bucket, tmp_path):
    put(bucket, **{
        "in/a.obj": b"v 0 0 0\nmtllib my looks.mtl\r\n",
        "in/my looks.mtl": b"newmtl m\n  map_Kd -s 1 1 1 pictures/skin.png\nmap_Ka other%20one.png\n",
        "in/pictures/skin.png": b"png", "in/other one.png": b"png", "in/secret.txt": b"no",
    })  # fmt: skip
    path = fetch(f"{bucket}/in/a.obj", tmp_path)
    assert path == tmp_path / "a.obj"
    there = {p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*") if p.is_file()}
    assert there == {"a.obj", "my looks.mtl", "pictures/skin.png", "other one.png"}
    assert len(with_named_files(path)) == 4


@pytest.mark.parametrize("name", ["../up.mtl", "/etc/passwd", "C:/a.mtl", "a/../../b.mtl", "http://a/b.mtl"])
def test_nothing_is_fetched_from_above(tmp_path, name):
    (tmp_path / "a.obj").write_text(f"mtllib {name}\n")
    assert names_in(tmp_path / "a.obj") == []


def test_names_in_gltf_and_ply(tmp_path):
    (tmp_path / "a.gltf").write_text('{"buffers": [{"uri": "a%20b.bin"}, {"uri": "data:x"}]}')
    assert set(names_in(tmp_path / "a.gltf")) == {"a%20b.bin", "a b.bin"}
    (tmp_path / "a.ply").write_bytes(b"ply\ncomment TextureFile skin.png\nend_header\n")
    assert names_in(tmp_path / "a.ply") == ["skin.png"]
    assert names_in(tmp_path / "none.obj") == []


def test_a_puzzle_is_there_with_its_report_which_comes_last(bucket, tmp_path, monkeypatch):
    puzzle = tmp_path / "puzzle"
    (puzzle / "pieces").mkdir(parents=True)
    for name in ("report.json", "a.stl", "pieces/z.stl"):
        (puzzle / name).write_text(name)
    put(bucket, **{"p/report.json": b"old", "p/old.stl": b"old"})
    order, push = [], places.push_file

    def noted(local, url):
        assert "p/report.json" not in listed(bucket)
        order.append(url.removeprefix(f"{bucket}/p/"))
        push(local, url)

    monkeypatch.setattr(places, "push_file", noted)
    push_folder(puzzle, f"{bucket}/p")
    assert order == ["a.stl", "pieces/z.stl", "report.json"]
    assert listed(bucket) == {"p/report.json", "p/a.stl", "p/pieces/z.stl"}
    assert pull_folder(f"{bucket}/p", tmp_path / "back")
    assert (tmp_path / "back" / "pieces" / "z.stl").read_text() == "pieces/z.stl"
    assert not pull_folder(f"{bucket}/none", tmp_path / "none")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no process groups")
def test_a_scan_goes_from_a_bucket_to_a_bucket(bucket, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    ball = trimesh.Trimesh(*sphere(300), process=False).export(file_type="ply")
    put(bucket, **{"in/ball.ply": ball})
    asked = task(f"{bucket}/in/ball.ply", f"{bucket}/out", name="deep/ball")
    record = make_scan(asked)
    assert (record.outcome, record.pieces) == ("made", 4)
    files = fsspec.filesystem("memory")
    root = f"/{bucket.removeprefix('memory://')}/out"
    report = json.loads(files.cat_file(f"{root}/deep/ball/report.json"))
    assert report["input"]["file"] == "in/ball.ply"
    assert {f"out/deep/ball/{name}" for name in report["files"]} | {"out/thumbnails/deep/ball.jpg"} == (
        listed(bucket) - {"in/ball.ply"}
    )
    again = make_scan(asked)
    assert (again.kept, again.marks) == (True, record.marks)
    assert not list(tmp_path.iterdir())
    gone = make_scan(task(f"{bucket}/in/none.ply", f"{bucket}/out"))
    assert (gone.kind, gone.exit) == ("input", 4)


def test_urls_are_taken_apart():
    assert file_name("https://a.org/b/c%20d.stl?version=1#top") == "c d.stl"
    assert file_name("s3://bucket/a b.stl") == "a b.stl"
    assert below("s3://bucket/", "a") == "s3://bucket/a"


def test_a_package_that_is_missing_is_named():
    with pytest.raises(ResourceError, match=r"can't be reached .* install meshjig"):
        reach("nonsense://a/b")
