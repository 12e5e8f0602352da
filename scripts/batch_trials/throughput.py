"""The speed of a batch beside that of xargs, in turn, on scans of one size."""

import os
import subprocess
import sys
import time
from pathlib import Path

from batch_trials.scans import command, sound_scans


def throughput(work: Path, n_scans: int, faces: int) -> bool:
    """Run both; tell whether the batch has at least 0.95 times the speed."""
    paths = sound_scans(work / "in", n_scans, faces)
    before = os.getloadavg()[0]
    begun = time.monotonic()
    subprocess.run(
        ["xargs", "-P2", "-I{}", "sh", "-c", f'exec "{sys.executable}" -m meshjig make "{{}}" -q --cores 1'
         f' -o "{work}/by-xargs/$(basename "{{}}")"'],
        input="\n".join(map(str, paths)), text=True, check=False,
    )  # fmt: skip
    by_xargs = time.monotonic() - begun
    begun = time.monotonic()
    words = command("batch", work / "in", "-o", work / "by-batch", "--workers", 2, "-q")
    subprocess.run(words, check=False)
    by_batch = time.monotonic() - begun
    made = [len(list((work / name).glob("*/report.json"))) for name in ("by-xargs", "by-batch")]
    ratio = f"{by_xargs / by_batch:.3f} times as fast"
    print(f"{made} made; xargs {by_xargs:.0f} s, batch {by_batch:.0f} s, {ratio}")
    print(f"load of the machine: {before:.1f} before, {os.getloadavg()[0]:.1f} in the end")
    return by_xargs >= 0.95 * by_batch and made == [n_scans, n_scans]
