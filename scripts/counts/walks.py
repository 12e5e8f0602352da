"""Loops that walk along a border: they go from one thing to what follows it."""

import ast
from collections.abc import Iterator

NO_BORDERS = {"root"}  # functions: up a tree of merged regions


def walks(tree: ast.AST) -> list[tuple[ast.AST, str]]:
    """List the innermost loops that go from one thing to what follows it, and the function of each."""
    loops = {}
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and function.name not in NO_BORDERS:
            for node in ast.walk(function):
                inner = [n for n in ast.walk(node) if isinstance(n, ast.While | ast.For)]
                if inner == [node] and _follows(node):
                    loops[node] = function.name
    return list(loops.items())


def _follows(loop: ast.AST) -> bool:
    """Tell whether a loop holds `at = after[at]`, `at = after.pop(at)`, `after[walk[-1]]` or the like."""
    given = [(t.id, value) for t, value in _assigned(loop) if isinstance(t, ast.Name)]
    for name, value in given:
        same = {name} | {t for t, v in given if isinstance(v, ast.Name) and v.id == name}
        key = _looked_up(value)
        if key is not None and (
            (isinstance(key, ast.Name) and key.id in same)
            or any(isinstance(n, ast.Subscript) and ast.unparse(n.slice) == "-1" for n in ast.walk(key))
        ):
            return True
    return False


def _assigned(loop: ast.AST) -> Iterator[tuple[ast.AST, ast.AST]]:
    for node in ast.walk(loop):
        if isinstance(node, ast.NamedExpr):
            yield node.target, node.value
        elif isinstance(node, ast.Assign):
            target, value = node.targets[0], node.value
            if isinstance(target, ast.Tuple):
                values = value.elts if isinstance(value, ast.Tuple) else [value] * len(target.elts)
                yield from zip(target.elts, values, strict=False)
            else:
                yield target, value


def _looked_up(value: ast.AST) -> ast.AST | None:
    """Give the key by which a value is looked up in a list, an array or a dict."""
    if isinstance(value, ast.Call) and ast.unparse(value.func) == "int":
        value = value.args[0]
    if isinstance(value, ast.Subscript):
        key = value.slice
    elif isinstance(value, ast.Call) and ast.unparse(value.func).endswith((".pop", ".get")) and value.args:
        key = value.args[0]
    else:
        return None
    return key.left if isinstance(key, ast.BinOp) and isinstance(key.right, ast.Constant) else key
