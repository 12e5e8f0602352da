"""Mutate small sound files, and see that meshjig reads each rightly or says in a sentence why not.

    scripts/fuzz.py 2000                  so many files through the command line
    scripts/fuzz.py 200 --kinds glb 3mf   of some kinds only
    scripts/fuzz.py 1 --first 731         the 732nd of them alone
    scripts/fuzz.py 2000 --keep DIR       files with faults are put there
    scripts/fuzz.py 100 --quick           by the library, in one process

A fault is a traceback, an exit code that stands for a bug or a crash, more than 60 s or 2 GB, two sentences
or none, less than nine tenths of the unhurt file's faces without a note, or a refusal of other line ends and
encodings. The same number and seed give the same files. The exit code is 1 where there was a fault.
"""

import argparse
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import NamedTuple

from fuzzing.judge import Answer, by_command, faults, in_process
from fuzzing.mutations import mutated
from fuzzing.seeds import KINDS, unhurt


class Case(NamedTuple):
    """One file to try."""

    number: int
    kind: str
    variant: int
    data: bytes
    names: list[str]  # of the mutations


def cases(first: int, count: int, kinds: tuple[str, ...] = KINDS, seed: int = 0) -> Iterator[Case]:
    """Give mutated files, in turn of every kind."""
    sound = {kind: unhurt(kind) for kind in kinds}
    for number in range(first, first + count):
        kind = kinds[number % len(kinds)]
        chance = random.Random(f"{seed} {number}")
        variant = chance.randrange(len(sound[kind]))
        yield Case(number, kind, variant, *mutated(kind, sound[kind][variant], chance))


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--quick", action="store_true")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(1 if a.quick else a.jobs) as pool:
        ask = partial(_ask, Path(folder), a.quick)
        (Path(folder) / "ball.stl").write_bytes(unhurt("stl")[0])
        known = {
            (kind, k): ask(Case(-1, kind, k, data, []))
            for kind in a.kinds
            for k, data in enumerate(unhurt(kind))
        }
        codes: Counter[int] = Counter()
        slowest, largest, n_bad = 0.0, 0.0, 0
        wanted = list(cases(a.first, a.count, tuple(a.kinds), a.seed))
        for case, answer in zip(wanted, pool.map(ask, wanted), strict=True):
            codes[answer.code] += 1
            slowest, largest = max(slowest, answer.seconds), max(largest, answer.memory)
            wrong = faults(answer, known[case.kind, case.variant], case.names)
            if wrong:
                n_bad += 1
                print(f"{case.number:6} .{case.kind} {'+'.join(case.names)}: {', '.join(wrong)}")
                print("       ", answer.said.strip()[:300].replace("\n", " | "), flush=True)
                if a.keep:
                    a.keep.mkdir(parents=True, exist_ok=True)
                    (a.keep / f"{case.number}.{case.kind}").write_bytes(case.data)
    shown = ", ".join(f"{n} x {code}" for code, n in sorted(codes.items()))
    most = f"at most {slowest:.1f} s, {largest / 1e6:.0f} MB"
    print(f"{a.count} files, {n_bad} with faults; exit codes {shown}; {most}")
    return 1 if n_bad else 0


def _ask(folder: Path, quick: bool, case: Case) -> Answer:
    path = folder / f"{case.number}_{case.variant}.{case.kind}"
    path.write_bytes(case.data)
    try:
        if quick:
            return in_process(case.kind, path)
        return by_command(case.kind, path, folder / "ball.stl")
    finally:
        path.unlink()


if __name__ == "__main__":
    sys.exit(main())
