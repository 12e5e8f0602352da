"""A scheduler and two workers started by hand, with nothing shared but a bucket behind s3 (moto's server)."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

from batch_trials.by_hand import scheduler, worker
from batch_trials.scans import command, sound_scans
from batch_trials.watching import leftovers, running

_SERVER = """
import sys, time
from moto.server import ThreadedMotoServer
ThreadedMotoServer("127.0.0.1", int(sys.argv[1])).start()
time.sleep(1e9)
"""


def bucket(work: Path, n_scans: int) -> bool:
    """Run the trial; tell whether all is as it should be."""
    s3, dask = _port(), _port()
    keys = {
        "AWS_ACCESS_KEY_ID": "a", "AWS_SECRET_ACCESS_KEY": "b", "AWS_DEFAULT_REGION": "us-east-1",
        "AWS_ENDPOINT_URL": f"http://127.0.0.1:{s3}",
    }  # fmt: skip
    os.environ |= keys
    started = [subprocess.Popen([sys.executable, "-c", _SERVER, str(s3)], stderr=subprocess.DEVNULL)]
    wrong: list[str] = []
    try:
        files = _filled_bucket(work, n_scans)
        started.append(scheduler(work / "scheduler", dask))
        for i in (0, 1):
            (work / f"tmp{i}").mkdir()
        started += [worker(work / f"worker{i}", dask, TMPDIR=str(work / f"tmp{i}")) for i in (0, 1)]
        wrong += _batches(work, dask, started, files, n_scans)
    finally:
        for one in reversed(started):
            one.terminate()
            one.wait()
    time.sleep(2)
    wrong += [f"left running: {one}" for one in running(str(work))]
    wrong += [f"left behind: {one}" for i in (0, 1) for one in leftovers(work / f"tmp{i}")]
    print("\n".join(wrong) or "all is in the bucket, nothing is left")
    return not wrong


def _filled_bucket(work: Path, n_scans: int) -> object:
    import fsspec

    files = fsspec.filesystem("s3", use_listings_cache=False)
    end = time.monotonic() + 60
    while True:
        try:
            files.mkdir("scans")
            break
        except Exception:
            if time.monotonic() > end:
                raise
            time.sleep(0.5)
    files.mkdir("puzzles")
    for path in sound_scans(work / "in", n_scans):
        files.put_file(str(path), f"scans/day/{path.name}")
    return files


def _batches(work: Path, port: int, started: list, files: object, n_scans: int) -> list[str]:
    words = command("batch", "s3://scans/day/", "-o", "s3://puzzles/done", "--json")
    words += ["--scheduler", f"tcp://127.0.0.1:{port}", "--pieces", "4", "--no-guide", "--format", "stl"]
    client = work / "client"
    client.mkdir()
    begun = time.monotonic()
    process = subprocess.Popen(words, cwd=client, stdout=subprocess.PIPE, text=True)
    while _done(files) < n_scans // 4 and process.poll() is None:
        time.sleep(0.5)
    victim = started[-1]
    print(f"{_done(files)} are done; a worker is killed, and another started", flush=True)
    for pid in [*_children(victim.pid), victim.pid]:
        os.kill(pid, signal.SIGKILL)
    victim.wait()
    started.append(worker(work / "worker2", port, TMPDIR=str(work / "tmp1")))
    summary = json.loads(process.communicate()[0])
    print(f"{time.monotonic() - begun:.0f} s: {summary}")
    wrong = (
        [] if process.returncode == 0 and summary["made"] == n_scans else [f"not all were made: {summary}"]
    )
    wrong += _as_listed(work, files)
    again = subprocess.run(words, cwd=client, capture_output=True, text=True, check=False)
    kept = json.loads(again.stdout)
    print(f"again: {kept}")
    there = [str(path).removeprefix("puzzles/done/") for path in files.find("puzzles/done")]
    for name in ("index.html", "summary.csv", "summary.parquet"):
        wrong += [] if name in there else [f"{name} is not in the bucket"]
    thumbnails = sum(name.startswith("thumbnails/") for name in there)
    wrong += [] if thumbnails == n_scans else [f"{thumbnails} thumbnails"]
    return wrong + ([] if kept["kept"] == n_scans else ["not all were kept"])


def _children(pid: int) -> list[int]:
    import psutil

    return [p.pid for p in psutil.Process(pid).children() if "spawn_main" in " ".join(p.cmdline())]


def _done(files: object) -> int:
    return sum(str(path).endswith("/report.json") for path in files.find("puzzles/done"))


def _as_listed(work: Path, files: object) -> list[str]:
    """Compare what is in the bucket with what the reports list."""
    import hashlib

    wrong = []
    for path in files.find("puzzles/done"):
        if not str(path).endswith("/report.json"):
            continue
        folder = str(path).rpartition("/")[0]
        listed = json.loads(files.cat_file(path))["files"]
        there = {str(one).removeprefix(folder + "/") for one in files.find(folder)}
        if there != set(listed):
            wrong.append(f"{folder}: {sorted(there ^ set(listed))}")
        for name in there - {"report.json"}:
            if hashlib.sha256(files.cat_file(f"{folder}/{name}")).hexdigest() != listed.get(name):
                wrong.append(f"{folder}/{name} is not as it was written")
    return wrong


def _port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])
