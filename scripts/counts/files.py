"""The files of a package, and which of them imports which."""

import ast
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

ENTRANCES = {"__init__", "__main__"}


@dataclass(frozen=True)
class File:
    """One Python file of the package."""

    path: Path  # within the package
    text: str

    @cached_property
    def tree(self) -> ast.Module:
        """What the file says."""
        return ast.parse(self.text)

    @property
    def room(self) -> str:
        """The folder at the top that it is in, or itself."""
        return self.path.parts[0].removesuffix(".py")

    @property
    def folder(self) -> str:
        """The folder that it is in, at any depth, or itself where it is at the top."""
        return self.room if self.path.parent == Path() else self.path.parent.as_posix()

    def __str__(self) -> str:
        return self.path.as_posix()

    def at(self, node: ast.AST, what: str = "") -> str:
        """Name a place in the file."""
        return f"{self}:{node.lineno} {what}".strip()


def read(package: Path) -> list[File]:
    """Read all Python files of a package."""
    return [
        File(p.relative_to(package), p.read_text(encoding="utf-8")) for p in sorted(package.rglob("*.py"))
    ]


def imports(package: str, files: list[File]) -> list[tuple[File, File]]:
    """List which file imports which, each pair once."""
    modules = {".".join([package, *f.path.with_suffix("").parts]).removesuffix(".__init__"): f for f in files}
    found = {}
    for f in files:
        inside = [package, *f.path.parent.parts]
        for node in _run(f.tree):
            for name in _imported(node, inside):
                while name and name not in modules:
                    name = name.rpartition(".")[0]
                if name and modules[name] is not f:
                    found[f.path, name] = f, modules[name]
    return list(found.values())


def _run(tree: ast.AST) -> Iterator[ast.AST]:
    """Walk over what is run, leaving out what is for type checkers only."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) in {"TYPE_CHECKING", "typing.TYPE_CHECKING"}:
            yield from (inner for other in node.orelse for inner in [other, *_run(other)])
        else:
            yield node
            yield from _run(node)


def _imported(node: ast.AST, inside: list[str]) -> list[str]:
    """Name what a statement imports; `inside` are the packages that it stands in."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    above = inside[: len(inside) + 1 - node.level] if node.level else []
    home = ".".join([*above, *([node.module] if node.module else [])])
    return [f"{home}.{alias.name}" for alias in node.names]


def arrows(pairs: list[tuple[str, str]]) -> list[str]:
    """List which room imports which, each pair once, and by how many imports."""
    counts = Counter((a, b) for a, b in pairs if a != b and not {a, b} & ENTRANCES)
    return [f"{a} -> {b} {count}" for (a, b), count in sorted(counts.items())]


def circles(files: list[File], links: list[tuple[File, File]]) -> list[str]:
    """List the groups of files of which each leads to each other by imports."""
    onward = {f.path: {b.path for a, b in links if a is f} for f in files}
    reached = {path: _reached(path, onward) for path in onward}
    in_circles = [p for p in onward if p in reached[p]]
    groups = {frozenset(q for q in reached[p] if p in reached[q]) for p in in_circles}
    return [", ".join(sorted(path.as_posix() for path in group)) for group in groups]


def _reached(start: Path, onward: dict[Path, set[Path]]) -> set[Path]:
    reached, left = set(), [start]
    while left:
        new = onward[left.pop()] - reached
        reached |= new
        left += new
    return reached
