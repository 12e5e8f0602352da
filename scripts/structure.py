"""Count the structure of the package: rooms, arrows, circles, and words that have their home in mesh/.

    scripts/structure.py            a table of figures, each with its limit
    scripts/structure.py --check    only the limits that are broken; exit code 1 where there is one
    scripts/structure.py --arrows   also the arrows, and how many imports each stands for
    scripts/structure.py --where    also every place that was counted

A room is a folder at the top of the package, with all that is below it, or a module at the top beside
__init__ and __main__. An arrow is a pair of rooms of which one imports the other, anywhere but under
TYPE_CHECKING. import-linter checks which way arrows may point.
"""

import argparse
import ast
import sys
from pathlib import Path

from counts.files import ENTRANCES, File, arrows, circles, imports, read
from counts.walks import walks
from counts.words import any_dicts, calls, parameters, ragged, shared, values

MOST_PARAMETERS, MOST_VALUES = 6, 3
MEET_FILES = {"puzzle.py", "options.py", "cli/flags.py", "pipeline/report.py", "output/report.py"}

ROOMS, NESTED_ROOMS = "rooms", "rooms, folders inside folders too"
ARROWS, NESTED_ARROWS = "arrows", "arrows, folders inside folders too"
TOP, FILES, LINES, CIRCLES = "modules at the top", "files", "lines", "circles of files"
LONG = "functions with 7 parameters or more"
WIDE = "functions that return more than 3 unnamed values"
CALLED = {
    "connected_components": "connected_components outside mesh",
    "remesh_self_intersections": "remesh_self_intersections outside mesh",
    "EmbreeScene": "Embree scenes built outside mesh",
}
RAGGED, WALKS = "ragged ranges outside mesh", "border walks outside mesh"
DICTS, OTHER_DICTS = "dict[str, Any]", "dict[str, Any] elsewhere than where files are met"
SHARED = "blocks of more than 8 lines that come twice"

LIMITS = {
    **{ROOMS: 22, ARROWS: 80, TOP: 6, FILES: 450, LINES: 53_000, CIRCLES: 0, LONG: 10, WIDE: 0},
    **dict.fromkeys([*CALLED.values(), RAGGED, WALKS, OTHER_DICTS, SHARED], 0),
}


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="only the limits that are broken")
    parser.add_argument("--arrows", action="store_true", help="print the arrows too")
    parser.add_argument("--where", action="store_true", help="print every place that was counted")
    parser.add_argument("--package", type=Path, default=Path(__file__).resolve().parents[1] / "meshjig")
    a = parser.parse_args()
    found = count(a.package)
    broken = {name for name, limit in LIMITS.items() if len(found[name]) > limit}
    for name, places in found.items():
        if a.check and name not in broken:
            continue
        limit = f", at most {LIMITS[name]}" if name in LIMITS else ""
        print(f"{len(places):6}  {name}{limit}")
        if (a.where and name != LINES) or (a.arrows and name == ARROWS):
            print("".join(f"{'':12}{place}\n" for place in places), end="")
    return 1 if a.check and broken else 0


def count(package: Path) -> dict[str, list[str]]:
    """List, for each figure, what is counted."""
    files = read(package)
    outside = [f for f in files if f.room != "mesh"]
    links = imports(package.name, files)
    dicts = [(f, f.at(n)) for f in files for n in any_dicts(f.tree)]
    return {
        ROOMS: sorted({f.room for f in files} - ENTRANCES),
        NESTED_ROOMS: sorted({f.folder for f in files} - ENTRANCES),
        ARROWS: arrows([(a.room, b.room) for a, b in links]),
        NESTED_ARROWS: arrows([(a.folder, b.folder) for a, b in links]),
        TOP: sorted({f.room for f in files if f.path.parent == Path()} - ENTRANCES),
        FILES: [str(f) for f in files],
        LINES: [line for f in files for line in f.text.splitlines()],
        CIRCLES: circles(files, links),
        **_functions(files),
        **_called(outside),
        RAGGED: [f.at(n) for f in outside for n in ragged(f.tree)],
        WALKS: [f.at(n, name) for f in outside for n, name in walks(f.tree)],
        DICTS: [place for _, place in dicts],
        OTHER_DICTS: [place for f, place in dicts if str(f) not in MEET_FILES],
        SHARED: shared(files),
    }


def _functions(files: list[File]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {LONG: [], WIDE: []}
    for f in files:
        for n in ast.walk(f.tree):
            if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef):
                taken, given = parameters(n), values(n.returns)
                found[LONG] += [f.at(n, f"{n.name} {taken}")] if taken > MOST_PARAMETERS else []
                found[WIDE] += [f.at(n, f"{n.name} {given}")] if given > MOST_VALUES else []
    return found


def _called(files: list[File]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {figure: [] for figure in CALLED.values()}
    for f in files:
        for node, name in calls(f.tree):
            if name in CALLED:
                found[CALLED[name]].append(f.at(node))
    return found


if __name__ == "__main__":
    sys.exit(main())
