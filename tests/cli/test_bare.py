"""A flag that may stand alone has its value, wherever it stands."""

import pytest

from meshjig.cli.bare import with_values


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ("make --flat-base", "make --flat-base auto"),
        ("make --flat-base scan.ply", "make --flat-base auto scan.ply"),
        ("make scan.ply --flat-base --json", "make scan.ply --flat-base auto --json"),
        ("make scan.ply --flat-base 3.5 --json", "make scan.ply --flat-base 3.5 --json"),
        ("make scan.ply --flat-base auto", "make scan.ply --flat-base auto"),
        ("make scan.ply --flat-base deep", "make scan.ply --flat-base deep"),  # refused as a value
        ("make scan.ply --flat-base -1", "make scan.ply --flat-base -1"),
        ("make scan.ply --pieces 3", "make scan.ply --pieces 3"),
    ],
)
def test_a_flag_alone_gets_its_value(given, meant):
    assert with_values(given.split()) == meant.split()
