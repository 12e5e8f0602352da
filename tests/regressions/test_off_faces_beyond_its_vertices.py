"""A damaged OFF file: pymeshlab follows its faces to vertices that are not there, and may give a surface."""

import pytest

from meshjig.errors import InputError
from meshjig.scan.files import reading

TEXT = "OFF\n4 1 0\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n4 0 1 2 7\n"


def test_no_second_reader_is_asked_about_an_off_file(tmp_path, monkeypatch):
    path = tmp_path / "damaged.off"
    path.write_text(TEXT)
    asked = []
    monkeypatch.setattr(reading, "_by_pymeshlab", asked.append)
    with pytest.raises(InputError, match="1 of its 1 faces can't be read"):
        reading.read_file(str(path))
    assert asked == []
