"""Tilings are found by name; what other packages bring along is checked and never stops the rest."""

import logging

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.tiling.registry import family_names, get_family

PACKAGE = '''
from meshjig.tiling.families.regular import hexagons

def good(seed, columns):
    """Hexagons from elsewhere.

    More about them.
    """
    good.asked = seed, columns
    return hexagons()

def fails(seed, columns):
    raise RuntimeError("no luck")

def quits(seed, columns):
    raise SystemExit(7)

def no_unit(seed, columns):
    return 3

def no_tiling(seed, columns):
    from dataclasses import replace
    unit = hexagons()
    return replace(unit, translations=2 * unit.translations)
'''
POINTS = """[meshjig.tilings]
good = a_package:good
fails = a_package:fails
quits = a_package:quits
no-unit = a_package:no_unit
no-tiling = a_package:no_tiling
missing = a_package:not_there
unimportable = no_such_package:tiling
classic = a_package:fails
"""


@pytest.fixture
def _package(tmp_path, monkeypatch):
    """A package that is installed and brings tilings, most of them bad."""
    (tmp_path / "a_package.py").write_text(PACKAGE)
    info = tmp_path / "a_package-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: a-package\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(POINTS)
    monkeypatch.syspath_prepend(tmp_path)


def test_what_other_packages_import_stays_where_it_is():
    from meshjig.tiling import Unit
    from meshjig.tiling.template import Template
    from meshjig.tiling.unit import Unit as TheSame

    unit = get_family("classic")
    assert Unit is TheSame is type(unit)
    assert isinstance(unit.template(4), Template)


def test_all_names_have_one_line_about_them():
    names = dict(family_names())
    assert {"classic", "rectangular", "macro", "hex", "polyomino", "isohedral:IHnn", "FILE.svg"} <= set(names)
    assert sum(name.startswith("escher:") for name in names) >= 3
    assert all(line and "\n" not in line for line in names.values())


@pytest.mark.parametrize(
    ("wrong", "right"),
    [("clasic", "classic"), ("hexagon", "hex"), ("Macro", "macro"), ("polyominoes", "polyomino")],
)
def test_misspelt_name_is_answered_with_the_closest(wrong, right):
    with pytest.raises(OptionError, match=rf"'{wrong}': did you mean {right}\?.*rectangular.*FILE\.svg"):
        get_family(wrong)


def test_unlike_anything_is_answered_with_all_names():
    with pytest.raises(OptionError, match="known are classic, rectangular, macro"):
        get_family("zzzzzz")


def test_seed_and_columns_reach_the_family():
    assert get_family("polyomino", columns=5).translations[0, 0] == pytest.approx(2.5)
    assert not np.array_equal(get_family("polyomino", 1).sides, get_family("polyomino", 2).sides)


@pytest.mark.usefixtures("_package")
def test_other_package_brings_a_tiling():
    import a_package

    unit = get_family("good", seed=4, columns=7)
    assert len(unit.ends) == 3
    assert a_package.good.asked == (4, 7)
    assert ("good", "Hexagons from elsewhere.") in family_names()


@pytest.mark.usefixtures("_package")
@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("fails", "RuntimeError: no luck"),
        ("quits", "SystemExit: 7"),
        ("no-unit", "gives int where Unit is needed"),
        ("no-tiling", "mean area"),
        ("missing", "not_there"),
        ("unimportable", "no_such_package"),
    ],
)
def test_tiling_that_does_not_work_is_refused_with_its_package(name, reason):
    with pytest.raises(OptionError, match=rf"{name} \(package a-package\) does not work: .*{reason}"):
        get_family(name)


@pytest.mark.usefixtures("_package")
def test_broken_tilings_are_named_in_warnings_and_the_rest_is_listed(caplog):
    with caplog.at_level(logging.WARNING, "meshjig"):
        names = [name for name, _ in family_names()]
    assert {"classic", "good", "FILE.svg"} <= set(names)
    assert not {"missing", "unimportable"} & set(names)
    warned = " ".join(caplog.messages)
    assert "missing (package a-package)" in warned
    assert "unimportable (package a-package)" in warned


@pytest.mark.usefixtures("_package")
def test_own_tilings_can_not_be_replaced():
    assert len(get_family("classic").ends) == 2
    assert [name for name, _ in family_names()].count("classic") == 1


@pytest.mark.usefixtures("_package")
@pytest.mark.parametrize("text", [b"[meshjig.tilings]\nno value\n", b"\xff\xfe\x00"])
def test_a_damaged_list_of_entry_points_stops_nobody(tmp_path, text, caplog):
    info = tmp_path / "broken-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: broken\nVersion: 1.0\n")
    (info / "entry_points.txt").write_bytes(text)
    with caplog.at_level(logging.WARNING, "meshjig"):
        assert len(get_family("good").ends) == 3
    assert "the list of entry points of broken is damaged" in caplog.text
