"""Trials of meshjig batch on this machine: what must not be lost, left over, or made twice.

    scripts/batch_trials.py mixed DIR [--cases FOLDER] [--scans 400]
    scripts/batch_trials.py bucket DIR [--scans 40]
    scripts/batch_trials.py list DIR [--scans 10000000]
    scripts/batch_trials.py speed DIR [--scans 24] [--faces 50000]
    scripts/batch_trials.py client|worker|scheduler DIR [--scans 24] [--kills 10] [--seed 0]

Each makes what it needs in DIR, which must be new, prints figures, and ends with 1 if something was wrong.
"""

import argparse
import sys
from pathlib import Path

from batch_trials.bucket import bucket
from batch_trials.kills import kills
from batch_trials.long_list import long_list
from batch_trials.mixed import mixed
from batch_trials.throughput import throughput

ROLES = ("client", "worker", "scheduler")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "trial", choices=["mixed", "bucket", "list", "speed", "client", "worker", "scheduler"]
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cases", type=Path)
    parser.add_argument("--scans", type=int)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--faces", type=int, default=50_000)
    a = parser.parse_args()
    work = a.folder.resolve()
    work.mkdir(parents=True)
    if a.trial == "mixed":
        good = mixed(work, a.cases, a.scans or 400)
    elif a.trial == "bucket":
        good = bucket(work, a.scans or 40)
    elif a.trial == "list":
        good = long_list(work, a.scans or 10_000_000, 60.0)
    elif a.trial == "speed":
        good = throughput(work, a.scans or 24, a.faces)
    else:
        good = kills(work, a.trial, a.scans or 24, a.kills, a.seed)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
