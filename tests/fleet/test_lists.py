"""Lists of scans, with options of their own."""

import itertools

import pytest

from meshjig.errors import InputError, OptionError
from meshjig.fleet.inputs import entries
from meshjig.fleet.lists import count_rows, read_list


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def named(inputs, rows=()):
    return {name: entry.source for name, entry in entries(inputs, rows)}


def test_a_text_is_a_list_of_scans(folder):
    (folder / "list.txt").write_text(
        "a/x.stl\n\n  /data/b c.stl \r\ns3://bucket/k.ply\n", encoding="utf-8-sig"
    )
    found = named([], read_list(folder / "list.txt"))
    assert found == {"x": f"{folder}/a/x.stl", "b c": "/data/b c.stl", "k": "s3://bucket/k.ply"}
    assert count_rows(folder / "list.txt") == 4


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_a_table_has_a_column_a_flag(folder, kind):
    path = folder / f"list.{kind}"
    rows = {"file": ["a/x.stl", "b/x.stl"], "pieces": ["30", ""], "knob-size": ["", "1.5"]}
    if kind == "csv":
        lines = [",".join(rows), *(",".join(row) for row in zip(*rows.values(), strict=True))]
        path.write_text("\n".join(lines) + "\n")
    else:
        pa, pq = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
        pq.write_table(pa.table(rows), path)
    first, second = read_list(path)
    assert (first.given, second.given) == ({"pieces": "30"}, {"knob_size": "1.5"})
    assert second.source == f"{folder}/b/x.stl"
    assert "row 2 of" in second.where
    assert count_rows(path) == 2


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        ("scan,pieces\n", InputError, "no column named file"),
        ("", InputError, "no column named file"),
        ("file,peices\na,1\n", OptionError, "'peices', which is no option: did you mean pieces"),
    ],
)
def test_a_table_that_is_wrong_says_where(folder, text, error, says):
    (folder / "list.csv").write_text(text)
    with pytest.raises(error, match=says):
        list(read_list(folder / "list.csv"))


def test_a_list_that_is_not_there_is_refused_at_once(folder):
    with pytest.raises(InputError, match=r"none\.txt is no file"):
        read_list(folder / "none.txt")


def test_a_long_list_is_read_as_it_is_used(folder):
    with (folder / "list.txt").open("w") as file:
        file.writelines(f"/in/{i}.stl\n" for i in range(200_000))
    rows = read_list(folder / "list.txt")
    assert [name for name, _ in itertools.islice(entries([], rows), 3)] == ["0", "1", "2"]
