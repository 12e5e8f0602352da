"""A command within limits: whatever it does, it ends, and nothing of it remains."""

import os
import signal
import sys
import time

import psutil
import pytest

from meshjig.fleet.watched_process import Cancelled, GroupLimits, run_watched

pytestmark = pytest.mark.skipif(os.name != "posix", reason="Windows has no process groups")

FORKS = """
import os, sys, time
for i in range(2):
    if os.fork() == 0:
        if i:
            os.setsid()
        time.sleep(600)
open('ready', 'w').close()
time.sleep({seconds})
"""


def run(folder, script, seconds=20.0, memory=4.0, cancelled=lambda: False):
    words = [sys.executable, "-c", script]
    return run_watched(words, GroupLimits(seconds, memory), folder, dict(os.environ), cancelled)


def below(folder):
    """List the processes whose current folder is this one; the system may take a moment to end them."""
    end = time.monotonic() + 2
    while (found := at_work_in(folder)) and time.monotonic() < end:
        time.sleep(0.05)
    return found


def at_work_in(folder):
    found = []
    for process in psutil.process_iter():
        try:
            if process.cwd() == str(folder) and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process.pid)
        except psutil.Error:
            continue
    return found


def test_what_it_prints_and_how_it_ends_is_told(tmp_path):
    ended = run(tmp_path, "import sys; print('out'); print('a\\nb', file=sys.stderr); sys.exit(7)")
    assert (ended.code, ended.beyond, ended.answer, ended.said) == (7, "", "out", "a\nb")
    assert 0 < ended.seconds < 20


def test_a_signal_is_told(tmp_path):
    assert run(tmp_path, "import os; os.kill(os.getpid(), 11)").code == -signal.SIGSEGV


@pytest.mark.parametrize("seconds", [0, 600])
def test_children_go_with_it_those_that_left_the_group_too(tmp_path, seconds):
    ended = run(tmp_path, FORKS.format(seconds=seconds or 0.8), seconds=20.0 if not seconds else 1.5)
    assert (tmp_path / "ready").exists()
    assert ended.beyond == ("time" if seconds else "")
    assert not below(tmp_path)


def test_too_much_memory_of_all_together_ends_it(tmp_path):
    script = "import os, time\nos.fork()\nheld = bytearray(b'x') * 200_000_000\ntime.sleep(600)"
    ended = run(tmp_path, script, memory=0.3)
    assert ended.beyond == "memory"
    assert 330 < ended.peak_mb < 900
    assert not below(tmp_path)


def test_it_may_clear_up_before_it_is_killed(tmp_path):
    script = (
        "import signal, sys, time\n"
        "def end(*_):\n    open('cleared', 'w').close(); sys.exit(0)\n"
        "signal.signal(signal.SIGTERM, end)\ntime.sleep(600)"
    )
    assert run(tmp_path, script, seconds=0.8).beyond == "time"
    assert (tmp_path / "cleared").exists()


def test_who_does_not_hear_is_killed(tmp_path):
    script = "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\ntime.sleep(600)"
    begun = time.monotonic()
    assert run(tmp_path, script, seconds=0.5).code == -signal.SIGKILL
    assert time.monotonic() - begun < 6


def test_nobody_waits_for_what_is_cancelled(tmp_path):
    with pytest.raises(Cancelled):
        run(tmp_path, "import time; time.sleep(600)", cancelled=lambda: True)
    assert not below(tmp_path)
