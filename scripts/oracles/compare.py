"""Say what differs between two records of puzzles, and by how much."""

import json
import math
from itertools import groupby
from pathlib import Path

JUDGED = {"ok", "failures", "checks"}
CLOSE = 1e-6
ENOUGH = 4  # names listed of what differs alike


def compare(old: Path, new: Path, only: list[str] | None, sets: list[str] | None, close_passes: bool) -> int:
    """Print what differs, and give the exit code."""
    a, b = (
        _chosen(json.loads(path.read_text(encoding="utf-8"))["puzzles"], only, sets) for path in (old, new)
    )
    grades = []
    for name in sorted(a.keys() | b.keys()):
        if name not in a or name not in b:
            grade, lines = "missing", [f"only in {old if name in a else new}"]
        else:
            lines = _differences(a[name], b[name])
            grade = "equal" if not lines else "close" if _is_close(a[name], b[name]) else "different"
        grades.append(grade)
        if lines:
            print("\n    ".join([f"{name}: {grade}", *lines]))
    counts = ", ".join(f"{grades.count(g)} {g}" for g in ("equal", "close", "different", "missing"))
    failed = sum("failure" in made for made in b.values())
    print(f"{len(grades)} puzzles: {counts}; {failed} of the new ones failed")
    return 0 if grades and set(grades) <= ({"equal", "close"} if close_passes else {"equal"}) else 1


def _chosen(puzzles: dict, only: list[str] | None, sets: list[str] | None) -> dict:
    parts = {name: name.rsplit(" ", 1) for name in puzzles}
    return {
        name: puzzles[name]
        for name, (mesh, chosen) in parts.items()
        if (not only or Path(mesh).stem in only) and (not sets or chosen in sets)
    }


def _is_close(a: dict, b: dict) -> bool:
    if a["input"] != b["input"] or "failure" in a or "failure" in b:
        return False
    if any(len(a[kind]) != len(b[kind]) for kind in ("pieces", "core")):
        return False
    x, y = (_leaves({k: made["report"].get(k) for k in JUDGED}) for made in (a, b))
    return x.keys() == y.keys() and all(_same(x[k], y[k], CLOSE) for k in x)


def _same(x: object, y: object, share: float) -> bool:
    if isinstance(x, float) and isinstance(y, float):
        return math.isclose(x, y, rel_tol=share, abs_tol=share * 1e-3) or (x != x and y != y)
    return type(x) is type(y) and x == y


def _differences(a: dict, b: dict) -> list[str]:
    """Say in lines what differs between two puzzles."""
    lines = [] if a["input"] == b["input"] else ["the mesh itself"]
    if "failure" in a or "failure" in b:
        x, y = a.get("failure", "a puzzle"), b.get("failure", "a puzzle")
        return lines if x == y else [*lines, f"failure: {x} -> {y}"]
    for kind in ("pieces", "core"):
        lines += _of_solids(kind, a[kind], b[kind])
    return lines + _of_reports(_leaves(a["report"]), _leaves(b["report"]))


def _of_solids(kind: str, a: dict, b: dict) -> list[str]:
    lines = [] if len(a) == len(b) else [f"{kind}: {len(a)} -> {len(b)}"]
    lines += [f"{kind}: names or their order"] if len(a) == len(b) and list(a) != list(b) else []
    both = [name for name in a if name in b and a[name] != b[name]]
    alike = [name for name in both if a[name]["V"][:2] == b[name]["V"][:2] and a[name]["F"] == b[name]["F"]]
    if both:
        boxes = [zip(a[name]["box"], b[name]["box"], strict=False) for name in both]
        apart = max((abs(x - y) for box in boxes for x, y in box), default=0.0)
        lines.append(
            f"{kind}: V or F of {len(both)} differ, of {len(alike)} only coordinates;"
            f" boxes by at most {apart:.1e} mm: {_some(both)}"
        )
    return lines


def _of_reports(a: dict, b: dict) -> list[str]:
    """Say which keys of two reports differ, those of a list's elements together."""
    both = a.keys() & b.keys()
    apart = (a.keys() ^ b.keys()) | {key for key in both if not _same(a[key], b[key], 0.0)}
    lines = []
    for name, keys in groupby(sorted(apart, key=lambda key: (_generic(key), str(key))), key=_generic):
        group = list(keys)
        pairs = [(a.get(key, "nothing"), b.get(key, "nothing")) for key in group]
        if all(isinstance(x, float) and isinstance(y, float) for x, y in pairs):
            share = max(abs(x - y) / max(abs(x), abs(y), 1e-300) for x, y in pairs)
            said = f"relative difference at most {share:.1e}"
        else:
            said = _some([f"{x} -> {y}" for x, y in pairs])
        lines.append(f"report {name}: {len(group)} differ, {said}")
    return lines


def _generic(key: tuple) -> str:
    return ".".join("*" if isinstance(part, int) else part for part in key)


def _leaves(value: object, at: tuple = ()) -> dict[tuple, object]:
    """List what is in nested dicts and lists by its place; an empty one is a leaf."""
    if not isinstance(value, dict | list) or not value:
        return {at: value}
    items = value.items() if isinstance(value, dict) else enumerate(value)
    return {key: leaf for part, inner in items for key, leaf in _leaves(inner, (*at, part)).items()}


def _some(names: list[str]) -> str:
    return ", ".join(names[:ENOUGH]) + (" and others" if len(names) > ENOUGH else "")
