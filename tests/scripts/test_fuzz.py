"""Mutated files of every kind are read rightly, or refused in a sentence."""

import subprocess
import sys

import pytest

from tests.docs.blocks import ROOT


@pytest.mark.slow
def test_a_hundred_mutated_files_do_no_harm():
    command = [sys.executable, str(ROOT / "scripts" / "fuzz.py"), "104", "--quick"]
    said = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    assert said.returncode == 0, said.stdout + said.stderr
    assert said.stdout.startswith("104 files, 0 with faults")


def test_the_same_seed_gives_the_same_files_and_another_one_others(tmp_path):
    sys.path.insert(0, str(ROOT / "scripts"))
    try:
        from fuzz import cases
    finally:
        sys.path.pop(0)
    first, again, other = (list(cases(0, 16, seed=seed)) for seed in (1, 1, 2))
    assert first == again
    assert first != other
    assert {case.kind for case in first} == {"obj", "stl", "ply", "off", "glb", "3mf", "svg", "toml"}


def test_a_loss_without_a_word_is_a_fault():
    sys.path.insert(0, str(ROOT / "scripts"))
    try:
        from fuzzing.judge import Answer, faults
    finally:
        sys.path.pop(0)
    whole = Answer(0, "", faces=100)
    assert not faults(Answer(0, "", faces=91), whole, ["word"])
    assert faults(Answer(0, "", faces=89), whole, ["word"])
    assert not faults(Answer(0, "", faces=89, notes=("11 faces are left out",)), whole, ["word"])
    assert faults(Answer(4, "meshjig: no"), whole, ["as_cr"])
    assert faults(Answer(70, "Traceback\nmeshjig: oh"), whole, ["word"])
    assert faults(Answer(4, "meshjig: no\nmeshjig: and no"), whole, ["word"])
