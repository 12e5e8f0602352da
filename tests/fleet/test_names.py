"""Folders of a batch: each scan its own, whatever scans are called."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshjig.fleet.names import KeySet, Names


def test_a_scan_gives_its_name_without_the_suffix():
    names = Names()
    assert names.give("deep/down/scan 1.stl") == "scan 1"
    assert names.give("vase.v2.ply") == "vase.v2"


def test_names_that_clash_keep_their_relative_paths():
    names = Names()
    names.share("x")
    assert [names.give(path) for path in ("a/x.stl", "b/x.stl", "b/y.stl")] == ["a/x", "b/x", "y"]


def test_of_a_list_the_first_has_the_name():
    names = Names()
    assert [names.give(path) for path in ("a/x.stl", "b/X.stl", "b/x.obj", "b/x.obj")] == [
        "x", "b/X", "b/x.obj", "b-x.obj-2",
    ]  # fmt: skip


@pytest.mark.parametrize("path", ["index.html", "batch.jsonl.stl", "thumbnails.stl", "summary.csv.ply"])
def test_what_a_batch_writes_itself_is_no_name(path):
    assert Names().give(path) not in {"index.html", "batch.jsonl", "thumbnails", "summary.csv"}


@pytest.mark.parametrize(
    "path", ["../../etc/x.stl", "/x.stl", "./.hidden.stl", "a//b/../x.stl", "", "..", "/"]
)
def test_no_name_leads_out_of_the_folder_or_is_hidden(path):
    names = Names()
    for name in [names.give(path) for _ in range(3)]:
        assert name
        assert not name.startswith(("/", "."))
        assert not {"", ".", ".."} & set(name.split("/"))


def test_long_names_are_cut_and_stay_apart():
    names = Names()
    first, second = names.give("é" * 300 + "a.stl"), names.give("é" * 300 + "b.stl")
    assert first != second
    assert max(len(name.encode()) for name in (first, second)) < 200


part = st.sampled_from(["a", "A", "b", ".h", "x.stl", "a.stl", "thumbnails", "..", "", "long" * 60])


@given(st.lists(st.lists(part, min_size=1, max_size=3).map("/".join), max_size=30))
def test_no_name_comes_twice_or_lies_below_another(paths):
    names = Names()
    given = [names.give(path) for path in paths]
    folded = [name.casefold() for name in given]
    assert len(set(folded)) == len(folded)
    for name in folded:
        assert not any(other.startswith(name + "/") for other in folded)


def test_a_set_of_keys_holds_what_was_put_in():
    rng = random.Random(0)
    keys = {rng.getrandbits(64) for _ in range(20_000)} | {0}
    held = KeySet()
    assert 0 not in held
    for key in keys:
        held.add(key)
        held.add(key)
    assert all(key in held for key in keys)
    assert not any(rng.getrandbits(64) in held for _ in range(1000))
