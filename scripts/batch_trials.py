"""Trials of meshjig batch on this machine: what must not be lost, left over, or made twice.

    scripts/batch_trials.py mixed DIR [--cases FOLDER] [--sound 300] [--all 400]

Each makes what it needs in DIR, which must be new, prints figures, and ends with 1 if something was wrong.
"""

import argparse
import sys
from pathlib import Path

from batch_trials.mixed import mixed


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("trial", choices=["mixed"])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cases", type=Path)
    parser.add_argument("--sound", type=int, default=300)
    parser.add_argument("--all", type=int, default=400)
    a = parser.parse_args()
    work = a.folder.resolve()
    work.mkdir(parents=True)
    good = mixed(work, a.cases, a.sound, a.all)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
