"""What a reader may use is limited, and what it does wrong ends as an exception."""

import os
import subprocess
import sys
import time

import psutil
import pytest

from meshjig.errors import InputError
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds


def test_an_answer_comes_back():
    assert Bounded("os", "getpid").result() != os.getpid()


def test_what_the_function_raises_is_raised_here(tmp_path):
    with pytest.raises(InputError, match="does not exist"):
        Bounded("meshjig.scan.files.reading", "read_file", str(tmp_path / "none.stl")).result()


def test_a_crash_is_told_from_a_limit():
    with pytest.raises(OutOfBounds, match="crash") as caught:
        Bounded("os", "abort").result()
    assert caught.value.crashed


def test_memory_is_limited():
    big = Bounded("builtins", "bytearray", 2_000_000_000, limits=Limits(memory=200e6, seconds=60))
    with pytest.raises(OutOfBounds, match="GB of memory") as caught:
        big.result()
    assert not caught.value.crashed
    assert not big._child.alive()


@pytest.mark.parametrize("waiting", [True, False])
def test_time_is_limited_at_work_and_at_waiting(waiting):
    limits = Limits(seconds=0.3)
    if waiting:
        slow = Bounded("time", "sleep", 600, limits=limits)
    else:
        slow = Bounded("math", "factorial", 3_000_000, limits=limits)
    with pytest.raises(OutOfBounds, match=r"takes more than \d+ s"):
        slow.result()
    assert not slow._child.alive()


def test_a_child_that_has_ended_while_it_was_idle_is_replaced():
    first = Bounded("os", "getpid")
    pid = first.result()
    psutil.Process(pid).kill()
    assert Bounded("os", "getpid").result() not in (pid, os.getpid())


def test_an_interrupt_ends_the_child(monkeypatch):
    slow = Bounded("time", "sleep", 600)

    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr(slow._threads[0], "join", interrupted)
    with pytest.raises(KeyboardInterrupt):
        slow.result()
    end = time.monotonic() + 20
    while slow._child.alive():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_package_of_the_answer_is_imported_as_a_whole_first():
    words = "import sys; from meshjig.runtime.bounded import Bounded\n"
    words += "answer = Bounded('os.path', 'basename', 'a/b', package='xml.dom').result()\n"
    words += "sys.exit(answer != 'b' or 'xml.dom' not in sys.modules)"
    assert subprocess.run([sys.executable, "-c", words], check=False).returncode == 0
