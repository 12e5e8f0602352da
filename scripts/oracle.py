"""Tell whether two checkouts of meshjig make equal puzzles of equal input.

    scripts/oracle.py record CHECKOUT FILE [MESH ...] [--only NAME ...] [--sets NAME ...] [--jobs N]
    scripts/oracle.py compare OLD NEW [--only NAME ...] [--sets NAME ...] [--close]

Run it with a Python that has the dependencies; meshjig itself is taken from CHECKOUT.

`record` makes puzzles of the models in the checkout's data/, of the bunny that pymeshlab brings and of
further meshes, with eight sets of options each. It writes to FILE, as JSON, a hash of every piece and the
report without its times, memory, version and path. Each puzzle is made in a process of its own.

`compare` prints what differs between two such files. A puzzle is "close" where it has as many pieces and
its checks, failures and verdict agree to 1e-6. The exit code is 0 when every puzzle is equal; with --close,
when every puzzle is equal or close.
"""

import argparse
import sys
from pathlib import Path

from oracles.compare import compare
from oracles.record import SETS, record


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("record", help="make puzzles with a checkout and write down what they are")
    one.add_argument("checkout", type=Path)
    one.add_argument("file", type=Path)
    one.add_argument("meshes", type=Path, nargs="*", help="meshes beside the models and the bunny")
    one.add_argument("--jobs", type=int, default=1, help="puzzles made at the same time")
    two = commands.add_parser("compare", help="compare two recorded files")
    two.add_argument("old", type=Path)
    two.add_argument("new", type=Path)
    two.add_argument("--close", action="store_true", help="let close puzzles pass")
    for command in (one, two):
        command.add_argument("--only", nargs="+", metavar="NAME", help="meshes, without folder and ending")
        command.add_argument("--sets", nargs="+", choices=SETS, metavar="NAME", help=", ".join(SETS))
    a = parser.parse_args()
    if a.command == "record":
        return record(a.checkout.resolve(), a.file, a.meshes, a.only, a.sets or list(SETS), a.jobs)
    return compare(a.old, a.new, a.only, a.sets, a.close)


if __name__ == "__main__":
    sys.exit(main())
