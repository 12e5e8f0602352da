"""What the code of a file says in words that belong elsewhere."""

import ast
from collections.abc import Iterator

from counts.files import File

MOST_SHARED = 8  # lines


def parameters(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Count the named parameters of a function, without self."""
    a = function.args
    return sum(p.arg not in {"self", "cls"} for p in [*a.posonlyargs, *a.args, *a.kwonlyargs])


def values(returns: ast.AST | None) -> int:
    """Count the values of a tuple that may be returned."""
    if isinstance(returns, ast.BinOp):
        return max(values(returns.left), values(returns.right))
    if isinstance(returns, ast.Subscript) and ast.unparse(returns.value) == "tuple":
        return len(returns.slice.elts) if isinstance(returns.slice, ast.Tuple) else 1
    return 0


def calls(tree: ast.AST) -> Iterator[tuple[ast.Call, str]]:
    """List calls and the last name of what is called, under whatever name it was imported."""
    imports = [n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)]
    names = {alias.asname: alias.name for n in imports for alias in n.names if alias.asname}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            last = ast.unparse(node.func).rpartition(".")[2]
            yield node, names.get(last, last)


def ragged(tree: ast.AST) -> list[ast.AST]:
    """List sums such as `cumsum(n) - n` and `arange(k) - repeat(first, n)`, one a line."""
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
            called = {name for _, name in calls(node)}
            if {"arange", "repeat"} <= called or _less_itself(node):
                found[node.lineno] = node
    return list(found.values())


def _less_itself(node: ast.BinOp) -> bool:
    """Tell whether something is taken from its own cumulative sum."""
    total = node.left
    if not isinstance(total, ast.Call) or not ast.unparse(total.func).endswith(".cumsum"):
        return False
    summed = total.args[0] if total.args else total.func.value
    return ast.dump(summed) == ast.dump(node.right)


def any_dicts(tree: ast.AST) -> list[ast.AST]:
    """List where a type is dict[str, Any]."""
    return [n for n in ast.walk(tree) if isinstance(n, ast.Subscript) and ast.unparse(n) == "dict[str, Any]"]


def shared(files: list[File]) -> list[str]:
    """List where blocks of lines come a second time; imports, comments and blank lines don't count."""
    first, found, last = {}, [], None
    for f in files:
        lines = _told(f)
        for i in range(len(lines) - MOST_SHARED):
            block = tuple(line for _, line in lines[i : i + MOST_SHARED + 1])
            here = f.path.as_posix(), lines[i][0]
            seen = first.setdefault(block, here)
            if seen != here:
                if last != (f.path, i - 1):
                    found.append(f"{here[0]}:{here[1]} as {seen[0]}:{seen[1]}")
                last = f.path, i
    return found


def _told(f: File) -> list[tuple[int, str]]:
    imports = [n for n in ast.walk(f.tree) if isinstance(n, ast.Import | ast.ImportFrom)]
    left_out = {k for n in imports for k in range(n.lineno, n.end_lineno + 1)}
    lines = [(k, line.strip()) for k, line in enumerate(f.text.splitlines(), 1) if k not in left_out]
    return [(k, line) for k, line in lines if line and not line.startswith("#")]
