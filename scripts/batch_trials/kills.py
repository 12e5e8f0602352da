"""Client, worker or scheduler of a batch killed at random moments: begun again, all is as without."""

import hashlib
import json
import os
import random
import signal
import socket
import subprocess
import time
from pathlib import Path

from batch_trials.by_hand import scheduler, worker
from batch_trials.scans import command, sound_scans
from batch_trials.watching import leftovers, running, tree

_OPTIONS = ["--pieces", "4", "--no-guide", "--no-viewer", "--format", "stl", "--timeout", "300"]
_PATIENCE = 10  # s in which what belonged to the killed one has to be gone


def kills(work: Path, role: str, n_scans: int, n_kills: int, seed: int) -> bool:
    """Run the trial for the client, a worker or the scheduler; tell whether all is as it should be."""
    sound_scans(work / "in", n_scans)
    (work / "tmp").mkdir()
    rng = random.Random(seed)
    reference = work / "reference"
    subprocess.run([*_words(work, reference), "--workers", "2", "-q"], check=True, cwd=work)
    out, finished, wrong = work / "out", {}, []
    for k in range(n_kills):
        if role == "worker" and k == 0:
            _kill_workers(work, out, [rng.uniform(0.5, 9.0) for _ in range(n_kills)])
        elif role != "worker":
            pause = rng.uniform(0.5, 9.0)
            said = _killed_once(work, out, role, pause, more=k % 3 > 0)
            print(f"kill {k + 1} after {pause:.1f} s: {said}", flush=True)
        wrong += _not_gone(work)
        done = _inodes(out)
        wrong += [f"{name} was made again" for name, inode in finished.items() if done.get(name) != inode]
        finished |= done
    print(f"{len(finished)} of {n_scans} are done", flush=True)
    words = [*_words(work, out), "--workers", "2", "--json"]
    environment = os.environ | {"TMPDIR": str(work / "tmp")}
    last = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
    print(f"to the end: exit {last.returncode}: {json.loads(last.stdout)}")
    if last.returncode:
        wrong.append(last.stderr)
    wrong += [f"{name} was made again" for name, inode in finished.items() if _inodes(out).get(name) != inode]
    if _hashes(out) != _hashes(reference):
        wrong.append("the files differ from those of a batch that nobody killed")
    lines = [json.loads(line) for line in (out / "batch.jsonl").read_text().splitlines()]
    made = [line["name"] for line in lines if line["event"] == "scan"]
    if sorted(made) != sorted(_inodes(reference)):
        wrong.append(f"{len(made)} records of {n_scans} scans")
    wrong += [f"left running: {one}" for one in running(str(work))]
    wrong += [f"left behind: {one}" for one in leftovers(work / "tmp")]
    print("\n".join(wrong) or f"{len(_hashes(out))} files equal, none made again, nothing left")
    return not wrong


def _words(work: Path, out: Path) -> list[str]:
    return command("batch", work / "in", "-o", out, *_OPTIONS)


def _killed_once(work: Path, out: Path, role: str, pause: float, more: bool) -> str:
    """Kill it after a pause; two times in three, once some more are done."""
    cluster, where = [], ["--workers", "2"]
    if role == "scheduler":
        port = _free_port()
        cluster = [scheduler(work / "s", port)]
        cluster += [worker(work / f"w{i}", port, TMPDIR=str(work / "tmp")) for i in (0, 1)]
        where = ["--scheduler", f"tcp://127.0.0.1:{port}"]
    before = len(_inodes(out))
    process = _begin(work, out, where)
    while more and process.poll() is None and len(_inodes(out)) == before:
        time.sleep(0.05)
    time.sleep(pause)
    family = tree(process.pid)
    if process.poll() is not None:
        return "it had ended"
    pid = cluster[0].pid if cluster else random.choice(family[:2]).pid  # in front, or the one behind it
    os.kill(pid, signal.SIGKILL)
    told = process.communicate()[1].strip().splitlines()
    for one in cluster:
        one.terminate()
        one.wait()
    return f"{len(_inodes(out))} are done; exit {process.returncode}: {' '.join(told[-1:])}"


def _kill_workers(work: Path, out: Path, pauses: list[float]) -> None:
    process = _begin(work, out, ["--workers", "2"])
    for pause in pauses:
        time.sleep(pause)
        workers = [p for p in tree(process.pid) if "spawn_main" in " ".join(p.cmdline())]
        if process.poll() is None and workers:
            random.choice(workers).kill()
            print(f"a worker was killed after {pause:.1f} s; {len(_inodes(out))} are done", flush=True)
    process.communicate()
    print(f"exit {process.returncode}")


def _begin(work: Path, out: Path, more: list[str]) -> subprocess.Popen:
    """Begin, or go on, and wait until the work is under way."""
    journal, environment = out / "batch.jsonl", os.environ | {"TMPDIR": str(work / "tmp")}
    before = journal.stat().st_size if journal.exists() else 0
    words = [*_words(work, out), *more]
    process = subprocess.Popen(words, env=environment, cwd=work, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and (journal.stat().st_size if journal.exists() else 0) == before:
        time.sleep(0.05)
    return process


def _not_gone(work: Path) -> list[str]:
    """Name what is still there some seconds after a kill."""
    end = time.monotonic() + _PATIENCE
    while left := running(str(work)):
        if time.monotonic() > end:
            return [f"left running after a kill: {one}" for one in left]
        time.sleep(0.1)
    return []


def _free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def _inodes(out: Path) -> dict[str, int]:
    return {path.parent.name: path.stat().st_ino for path in out.glob("*/report.json")}


def _hashes(out: Path) -> dict[str, str]:
    found = {}
    for path in sorted(out.glob("*/**/*")):
        if path.is_file() and path.name != "report.json":
            found[str(path.relative_to(out))] = hashlib.sha256(path.read_bytes()).hexdigest()
    for path in sorted(out.glob("*/report.json")):
        report = json.loads(path.read_text())
        for key in ("timings_s", "peak_memory_mb"):
            report.pop(key)
        report["files"].pop("report.json")
        found[str(path.relative_to(out))] = json.dumps(report, sort_keys=True)
    return found
