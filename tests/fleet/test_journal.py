"""The journal: what it says stays, and what was half written when its client was killed does no harm."""

import json

import pytest

from meshjig.errors import OutputError
from meshjig.fleet.journal import Journal, JournalIndex
from tests.fleet.scans import failed, made


def test_the_last_word_on_a_scan_counts(tmp_path):
    path = tmp_path / "deep" / "batch.jsonl"
    journal = Journal(path)
    journal.append("begin", {"version": "1"})
    journal.keep(failed("one"))
    journal.keep(made('na"me \u00e9\udce9'))
    place = journal.keep(made("one", pieces=7))
    journal.append("retry", failed("one").as_dict())
    assert [record.pieces for record in journal.records([place])] == [7]
    journal.close()
    again = Journal(path)
    assert again.find("one") == made("one", pieces=7)
    assert again.find('na"me \u00e9\udce9') == made('na"me \u00e9\udce9')
    assert again.find("two") is None
    again.close()
    events = [json.loads(line)["event"] for line in path.read_text().splitlines()]
    assert events == ["begin", "scan", "scan", "scan", "retry"]


@pytest.mark.parametrize("torn", [b"", b'{"event": "scan", "na', b"x" * 200_000])
def test_a_torn_last_line_is_cut_off(tmp_path, torn):
    path = tmp_path / "batch.jsonl"
    journal = Journal(path)
    journal.keep(made("one"))
    journal.close()
    whole = path.read_bytes()
    path.write_bytes(whole + torn)
    journal = Journal(path)
    assert path.read_bytes() == whole
    journal.keep(made("two"))
    journal.close()
    index = JournalIndex(path)
    assert index.find("one")[0] == made("one")
    assert index.find("two")[0] == made("two")
    index.close()


def test_only_one_batch_writes_to_a_journal(tmp_path):
    journal = Journal(tmp_path / "batch.jsonl")
    with pytest.raises(OutputError, match="another batch is writing"):
        Journal(tmp_path / "batch.jsonl")
    journal.close()
    Journal(tmp_path / "batch.jsonl").close()


def test_what_is_known_is_not_written_again(tmp_path):
    journal = Journal(tmp_path / "batch.jsonl")
    place = journal.keep(made("one"))
    journal.close()
    journal = Journal(tmp_path / "batch.jsonl")
    size = journal.path.stat().st_size
    assert journal.keep(made("one", kept=True)) == place
    assert journal.path.stat().st_size == size
    journal.keep(made("other", kept=True))  # found in its folder only
    assert journal.path.stat().st_size > size
    journal.close()


def test_other_shards_are_heard(tmp_path):
    other = Journal(tmp_path / "batch-1-of-2.jsonl")
    other.keep(made("one"))
    other.close()
    journal = Journal(tmp_path / "batch.jsonl", [other.path])
    assert journal.find("one") == made("one")
    journal.close()


def test_lines_of_others_are_passed_over(tmp_path):
    path = tmp_path / "batch.jsonl"
    path.write_bytes(b'{"event": "scan", "name": "one", "source": 3}\nnonsense\n\xff\xfe\n')
    journal = Journal(path)
    assert journal.find("one") is None
    journal.close()
