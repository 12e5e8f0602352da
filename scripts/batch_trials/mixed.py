"""400 runs in one batch with two workers: sound, broken and malicious ones."""

import csv
import json
import os
import subprocess
import time
from collections import Counter
from pathlib import Path

from batch_trials.scans import broken_scans, command, install_faults, sound_scans
from batch_trials.watching import Watcher, leftovers, running

EXPECTED = {
    "segfault": ("bug", 70, 11),
    "abort": ("bug", 70, 6),
    "killed": ("killed", None, 9),
    "hang": ("time-out", None, None),
    "hungry": ("resources", 5, None),
    "forks": ("time-out", None, None),
}


def mixed(work: Path, cases: Path | None, n_all: int) -> bool:
    """Run the trial; tell whether all is as it should be."""
    install_faults(work / "site")
    tmp = work / "tmp"
    tmp.mkdir()
    sound = sound_scans(work / "in", 3 * n_all // 4)
    rest = (
        sorted(p for p in cases.iterdir() if p.suffix in {".stl", ".obj", ".ply", ".glb", ".3mf"})
        if cases
        else []
    )
    broken = broken_scans(work / "in", n_all - len(sound) - len(rest) - len(EXPECTED))
    rows = [[path, ""] for path in (*sound, *rest, *broken)]
    for i, name in enumerate(EXPECTED):  # spread among the others
        rows.insert((i + 1) * len(rows) // 8, [sound[i].with_name(f"fault-{name}.stl"), f"fault-{name}"])
        (sound[0].parent / f"fault-{name}.stl").write_bytes(sound[0].read_bytes())
    with (work / "list.csv").open("w", newline="") as file:
        csv.writer(file).writerows([["file", "tile"], *rows])
    words = command("batch", "--from", work / "list.csv", "-o", work / "out", "--workers", 2, "--json")
    words += ["--pieces", "4", "--faces", "2000", "--no-guide", "--format", "stl", "--timeout", "60"]
    words += ["--memory", "2"]
    path = os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(work / "site")])
    begun = time.monotonic()
    process = subprocess.Popen(
        words, stdout=subprocess.PIPE, env=os.environ | {"TMPDIR": str(tmp), "PYTHONPATH": path}, text=True
    )
    watcher = Watcher(process.pid)
    watcher.watch(process)
    summary = json.loads(process.communicate()[0])
    print(f"{time.monotonic() - begun:.0f} s, exit {process.returncode}: {summary}")
    print(watcher.said())
    lines = [json.loads(line) for line in (work / "out" / "batch.jsonl").read_text().splitlines()]
    records = [line for line in lines if line["event"] == "scan"]
    wrong = _wrong(records, rows, {path.stem for path in sound})
    wrong += [f"left running: {one}" for one in {*watcher.left(), *running(str(tmp))}]
    wrong += [f"left behind: {one}" for one in leftovers(tmp)]
    print("\n".join(wrong) or "every record is right, nothing is left")
    return not wrong


def _wrong(records: list, rows: list, sound: set) -> list[str]:
    by_source = Counter(record["source"] for record in records)
    wrong = [f"{path}: {by_source[str(path)]} records" for path, _ in rows if by_source[str(path)] != 1]
    if len(records) != len(rows):
        wrong.append(f"{len(records)} records of {len(rows)} scans")
    for record in records:
        stem = Path(record["source"]).stem
        got = record["kind"], record["exit"], record["signal"]
        fault = stem.removeprefix("fault-")
        if stem in sound and record["outcome"] != "made":
            wrong.append(f"{stem}: {record['outcome']} {got} {record['message']} {record['broken']}")
        if stem.startswith("broken-") and got[:2] != ("input", 4):
            wrong.append(f"{stem}: {got}")
        if fault in EXPECTED and stem != fault:
            print(f"{stem}: {got}, {record['attempts']} attempts, {record['seconds']} s: {record['message']}")
            if got != EXPECTED[fault]:
                wrong.append(f"{stem}: {got} where {EXPECTED[fault]} should be")
    return wrong
