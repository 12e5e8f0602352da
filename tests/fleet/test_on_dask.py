"""Batches on Dask: a window of scans, workers that die, clients and schedulers that go away."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import psutil
import pytest

from meshjig.errors import ResourceError
from meshjig.fleet import cluster
from meshjig.fleet.cluster import connected, local_cluster
from meshjig.fleet.on_dask import _cancelled_by_dask, on_dask
from meshjig.fleet.watched_process import GroupLimits, run_watched
from tests.fleet.scans import made, task

pytest.importorskip("distributed")
ROOT = Path(__file__).parent.parent.parent


@pytest.fixture(scope="module")
def client():
    with local_cluster(1) as client:
        yield client


def nothing(asked):
    return made(asked.name)


def fails(asked):
    raise OSError(f"no {asked.name}")


def kills_its_worker_once(asked):
    if not Path(asked.source).exists():
        Path(asked.source).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return made(asked.name)


def sleeps(asked):
    """Do what a scan does that takes long."""
    folder = Path(asked.source)
    words = [sys.executable, "-c", "open('begun', 'w').close(); import time; time.sleep(600)"]
    run_watched(words, GroupLimits(600, 4), folder, dict(os.environ), _cancelled_by_dask())
    return made(asked.name)


def tasks(names, folder="/in"):
    waiting = iter(names)
    return lambda: next((task(folder, "/out", name) for name in waiting), None)


def wait(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def asleep(folder):
    found = []
    for process in psutil.process_iter():
        try:
            if process.cwd() == str(folder) and process.status() != psutil.STATUS_ZOMBIE:
                found.append(process)
        except psutil.Error:
            continue
    return found


def test_all_come_back_and_no_more_than_a_window_is_under_way(client):
    asked, most, names = 0, 0, []
    waiting = tasks(map(str, range(200)))

    def count():
        nonlocal asked
        one = waiting()
        asked += one is not None
        return one

    for one, record in on_dask(client, count, 12, nothing):
        most = max(most, asked - len(names))
        assert one.name == record.name
        names.append(record.name)
    assert sorted(names, key=int) == [str(i) for i in range(200)]
    assert most <= 12
    wait(lambda: not client.futures)


def test_what_a_worker_can_not_run_is_a_record_too(client):
    [(_, record)] = on_dask(client, tasks(["one"]), 5, fails)
    assert (record.outcome, record.kind, record.exit) == ("failed", "lost", None)
    assert "no one" in record.sentence


def test_a_scan_whose_worker_dies_is_made_by_the_next(client, tmp_path):
    [(_, record)] = on_dask(client, tasks(["one"], tmp_path / "killed"), 5, kills_its_worker_once)
    assert record == made("one")


@pytest.mark.slow
def test_workers_that_die_as_they_begin_are_replaced():
    with local_cluster(2) as client:
        end, n_killed = time.monotonic() + 5, 0
        while time.monotonic() < end:
            for process in psutil.Process().children(recursive=True):
                with contextlib.suppress(psutil.NoSuchProcess):  # as the dead are
                    if "spawn_main" in " ".join(process.cmdline()):
                        process.kill()
                        n_killed += 1
            time.sleep(0.1)
        assert n_killed > 2
        done = [record for _, record in on_dask(client, tasks(["one", "two"]), 5, nothing)]
    assert {record.name for record in done} == {"one", "two"}


CLIENT = """
import sys
from meshjig.fleet.cluster import connected
from meshjig.fleet.on_dask import on_dask
from tests.fleet.test_on_dask import sleeps, tasks
with connected(sys.argv[1], None) as client:
    list(on_dask(client, tasks(["one"], sys.argv[2]), 5, sleeps))
"""


def test_when_a_client_is_killed_its_work_ends(client, tmp_path):
    words = [sys.executable, "-c", CLIENT, client.scheduler.address, str(tmp_path)]
    other = subprocess.Popen(words, cwd=ROOT)
    wait(lambda: (tmp_path / "begun").exists())
    assert asleep(tmp_path)
    other.kill()
    other.wait()
    wait(lambda: not asleep(tmp_path), 10)


@pytest.fixture
def by_hand(tmp_path):
    """Start a scheduler and a worker as their commands do."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{one.getsockname()[1]}"
    port = address.rpartition(":")[2]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "DASK_TEMPORARY_DIRECTORY": str(tmp_path)}
    started = [
        subprocess.Popen(
            [sys.executable, "-m", "dask", *words, "--host", "127.0.0.1"],
            env=environment,
            cwd=tmp_path,
            stderr=subprocess.DEVNULL,
        )
        for words in (
            ["scheduler", "--port", port, "--no-dashboard", "--no-show"],
            ["worker", address, "--nthreads", "1", "--memory-limit", "0", "--no-dashboard", "--no-nanny"],
        )
    ]
    yield address, started
    for one in started:
        one.kill()
        one.wait()


def test_when_the_scheduler_goes_so_does_the_work_and_a_sentence_says_so(by_hand, tmp_path):
    address, (scheduler, _) = by_hand
    with connected(address, None) as client:
        client.wait_for_workers(1, timeout=60)
        [(_, record)] = on_dask(client, tasks(["one"]), 5, nothing)
        assert record == made("one")
        (tmp_path / "in").mkdir()
        begun = tmp_path / "in" / "begun"
        killer = threading.Thread(target=lambda: (wait(begun.exists), scheduler.kill()))
        killer.start()
        with pytest.raises(ResourceError, match="is gone: start one, and give the same command again"):
            list(on_dask(client, tasks(["two"], tmp_path / "in"), 5, sleeps))
        killer.join()
        wait(lambda: not asleep(tmp_path / "in"))


def test_where_no_scheduler_answers_a_sentence_says_so(monkeypatch):
    monkeypatch.setattr(cluster, "_TIMEOUT", 1)
    nobody = connected("tcp://127.0.0.1:9", None)
    with pytest.raises(ResourceError, match="no Dask scheduler answers at"), nobody:
        pass


def test_without_dask_a_sentence_says_what_to_install():
    script = (
        "import sys; sys.modules['distributed'] = None\n"
        "from meshjig.fleet.cluster import local_cluster\n"
        "with local_cluster(1): pass"
    )
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert "batch needs Dask, which is not installed: pip install 'meshjig[batch]'" in said.stderr
