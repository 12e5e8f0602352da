"""A run that goes beyond its limit of memory is ended, and has said why."""

import json
import os
import subprocess
import sys

import pytest

from meshjig.runtime.memory import family_memory

HUNGRY = """
import sys, time
from meshjig.runtime.memory import watch_memory
from meshjig.runtime.messages import tell_through
tell_through(int(sys.argv[1]))
watch_memory(0.3)
held = bytearray(b"x") * int(sys.argv[2])
time.sleep(float(sys.argv[3]))
"""


@pytest.mark.parametrize(("size", "seconds", "ended"), [(500_000_000, 60, True), (1_000_000, 0.5, False)])
def test_who_holds_too_much_is_killed_and_others_are_not(size, seconds, ended):
    reading, writing = os.pipe()
    words = [sys.executable, "-c", HUNGRY, str(writing), str(size), str(seconds)]
    code = subprocess.run(words, pass_fds=[writing], timeout=50, check=False).returncode
    os.close(writing)
    with os.fdopen(reading) as told:
        messages = [json.loads(line) for line in told]
    assert (code != 0) == ended
    assert [word for word, _ in messages] == ["memory"] * ended
    assert all("more than the 0.3 GB of --memory" in text for _, text in messages)


def test_children_count():
    before = family_memory()
    child = subprocess.Popen(
        [sys.executable, "-c", "x = bytearray(b'x') * 200_000_000; input()"], stdin=subprocess.PIPE
    )
    try:
        while family_memory() < before + 150e6:
            assert child.poll() is None
    finally:
        child.kill()
        child.communicate()
