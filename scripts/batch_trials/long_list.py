"""A list of ten million scans on which workers do nothing: when the first is back, what the client holds."""

import subprocess
import sys
import time
from pathlib import Path

import psutil

_CLIENT = """
import sys, time
from meshjig.fleet.batch import Batch
from meshjig.fleet.settings import BatchSettings
from meshjig.fleet.cluster import local_cluster
from pathlib import Path
from batch_trials.long_list import nothing

if __name__ == "__main__":
    with local_cluster(2) as client:
        settings = BatchSettings(listed=Path(sys.argv[1]))
        batch = Batch([], sys.argv[2], client, settings, {})
        batch.function = nothing
        end = None
        for record in batch:
            end = end or time.monotonic() + float(sys.argv[3])
            print(batch.tally.scans, batch.total() if batch.tally.scans == 1 else "", flush=True)
            if time.monotonic() > end:
                break
"""


def nothing(task):
    """Give a record at once, on a worker."""
    from meshjig.fleet.record import MADE, Marks, Record

    return Record(task.name, task.source, MADE, exit=0, pieces=1, marks=Marks("i", "o", "v"))


def long_list(work: Path, n_scans: int, seconds: float) -> bool:
    """Run the trial; tell whether both limits are kept."""
    path = work / "list.txt"
    with path.open("w") as file:
        for i in range(n_scans):
            file.write(f"/data/scans/day-{i // 1000:05d}/scan-{i:08d}.ply\n")
    here = str(Path(__file__).parent.parent)
    words = [sys.executable, "-c", f"import sys; sys.path.insert(0, {here!r})\n{_CLIENT}"]
    words += [str(path), str(work / "out"), str(seconds)]
    begun = time.monotonic()
    process = psutil.Popen(words, stdout=subprocess.PIPE, text=True)
    said = process.stdout.readline()
    first, most, n = time.monotonic() - begun, 0, 1
    for line in process.stdout:
        n = int(line)
        if n % 200 == 0:
            most = max(most, process.memory_info().rss)
    process.wait()
    print(f"{path.stat().st_size / 1e6:.0f} MB of list; the first ({said.strip()}) after {first:.1f} s,")
    print(f"{n} in {seconds:g} s after that; the client held {most / 1e6:.0f} MB at most")
    return first < 10 and most < 300e6
