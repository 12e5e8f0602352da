"""A drawing is read within limits, however many copies it asks for and however large it says it is."""

import time

import pytest

from meshjig.errors import OptionError
from meshjig.runtime.bounded import Limits
from meshjig.tiling.svg.user_unit import user_unit

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '


def doubled(times):
    """A square, and groups that each hold the one before twice."""
    use = '<use xlink:href="#g{}"/>'
    groups = "".join(f'<g id="g{k + 1}">{use.format(k) * 2}</g>' for k in range(times))
    square = '<g id="g0"><path d="M0 0H50V50H0Z"/></g>'
    return f'{HEAD}viewBox="0 0 100 100"><defs>{square}{groups}</defs>{use.format(times)}</svg>'


def test_copies_doubled_without_end_are_refused_in_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr("meshjig.tiling.svg.read_paths._LIMITS", Limits(memory=400e6, seconds=1.0))
    path = tmp_path / "ub.svg"
    path.write_text(doubled(30))
    began = time.monotonic()
    with pytest.raises(OptionError) as error:
        user_unit(path)
    assert time.monotonic() - began < 30
    said = str(error.value)
    assert len(said.splitlines()) == 1
    assert "ub.svg" in said


@pytest.mark.parametrize("size", ["1e160", "1e300"])
def test_a_drawing_larger_than_numbers_can_tell_has_a_sentence_and_no_warning(tmp_path, capfd, size):
    path = tmp_path / "huge.svg"
    path.write_text(
        f'{HEAD}viewBox="0 0 {size} {size}"><path d="M0,0 C {size},9 9,-{size} {size},0 V{size} H0 Z"/></svg>'
    )
    with pytest.raises(OptionError) as error:
        user_unit(path)
    assert len(str(error.value).splitlines()) == 1
    assert capfd.readouterr().err == ""
