"""The table and the page of a batch."""

import csv
import re

import pytest

from meshjig.fleet.page import write_page
from meshjig.fleet.results import write_results
from meshjig.fleet.summary import write_csv, write_parquet
from meshjig.fleet.tally import Tally
from tests.fleet.scans import failed, made

RECORDS = [
    made("one", shows=("viewer.html",), seconds=1.5),
    failed("<b>bad</b> & 'worse'", message="<script>alert(1)</script>\x1b[31m"),
    made("dir/t w\u00f6", outcome="broken", exit=3, broken=("gap_mm",)),
    failed("\udce9late", kind="time-out", exit=None, attempts=2),
]


def tally():
    counted = Tally()
    for record in RECORDS:
        counted.add(record)
    return counted


def test_what_is_counted():
    counted = tally()
    assert counted.as_dict() == {
        "ok": False, "scans": 4, "made": 1, "broken": 1, "failed": 2, "kept": 0, "retried": 0,
        "failures": {"input": 1, "time-out": 1}, "exit": 1,
    }  # fmt: skip
    assert str(counted) == ("4 scans, 1 made, 1 made with broken promises, 2 failed (input 1, time-out 1)")


@pytest.mark.parametrize(("records", "code"), [([], 0), ([0], 0), ([0, 2], 3), ([2, 1], 1)])
def test_the_exit_code_is_that_of_the_worst(records, code):
    counted = Tally()
    for i in records:
        counted.add(RECORDS[i])
    assert counted.exit == code


def test_the_table_has_a_row_a_scan(tmp_path):
    write_csv(tmp_path / "summary.csv", RECORDS)
    with (tmp_path / "summary.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["outcome"] for row in rows] == ["made", "failed", "broken", "failed"]
    assert (rows[0]["pieces"], rows[0]["y_mm"], rows[0]["seconds"]) == ("4", "2.0", "1.5")
    assert rows[1]["sentence"] == "<script>alert(1)</script>\\x1b[31m: export it again"
    assert (rows[3]["attempts"], rows[3]["exit"]) == ("2", "")


def test_the_table_as_parquet_has_types(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    assert write_parquet(tmp_path / "summary.parquet", RECORDS)
    table = parquet.read_table(tmp_path / "summary.parquet").to_pylist()
    assert [row["pieces"] for row in table] == [4, None, 4, None]
    assert table[0]["x_mm"] == 1.0


def test_the_page_shows_failures_first_and_runs_nothing_of_a_name(tmp_path):
    write_page(
        tmp_path / "index.html", [RECORDS[1], RECORDS[3], RECORDS[2], RECORDS[0]], tally(), "summary.csv"
    )
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "<script" not in text
    assert "\x1b" not in text
    assert "&lt;b&gt;bad" in text
    assert text.index("Failed: 2") < text.index("broken promises: 1") < text.index("Made: 1")
    assert "time-out, 2 times" in text
    assert {"one/viewer.html", "thumbnails/dir/t%20w%C3%B6.jpg"} <= set(
        re.findall(r'(?:href|src)="([^"]+)"', text)
    )
    assert not re.findall(r'(?:href|src)="(?:https?:)?//', text)


def test_results_are_written_whole_and_leave_nothing_else(tmp_path):
    write_results(str(tmp_path), lambda name: name.replace(".", "-1-of-2."), lambda: iter(RECORDS), tally())
    names = {path.name for path in tmp_path.iterdir()}
    assert names - {"summary-1-of-2.parquet"} == {"summary-1-of-2.csv", "index-1-of-2.html"}
    assert 'href="summary-1-of-2.csv"' in (tmp_path / "index-1-of-2.html").read_text(encoding="utf-8")
