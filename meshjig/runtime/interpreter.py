"""A fresh interpreter of ours, which runs nothing of the current folder and nothing of PYTHON* variables."""

from __future__ import annotations

import os
import sys

__all__ = ["interpreter_command"]

_BOOT = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location("meshjig", {init!r}, submodule_search_locations=[{home!r}])
sys.modules["meshjig"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sys.modules["meshjig"])
sys.path += {paths!r}
from {module} import {function}
{function}(*sys.argv[1:])
"""


def interpreter_command(module: str, function: str, *words: str) -> list[str]:
    """Give the command line of an interpreter that calls a function of meshjig.

    It is isolated (``-I``): no current folder, no PYTHONPATH, no PYTHONSTARTUP. meshjig is the one that runs
    here, by its file. Other places where modules were found here come last, behind the standard library and
    the installed packages, so that nothing in them can stand in for those.

    Parameters
    ----------
    module, function : str, of meshjig
    *words : str, what the function is called with

    Returns
    -------
    list of str
    """
    home = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    here = {"", os.curdir, _current_folder()}
    boot = _BOOT.format(
        init=os.path.join(home, "__init__.py"),
        home=home,
        paths=[path for path in sys.path if path not in here],
        module=module,
        function=function,
    )
    flags = ["-X", "utf8"] if sys.flags.utf8_mode else []
    return [
        sys.executable,
        "-I",
        *flags,
        *(["-B"] if sys.flags.dont_write_bytecode else []),
        "-c",
        boot,
        *words,
    ]


def _current_folder() -> str:
    try:
        return os.getcwd()
    except OSError:  # it was removed
        return ""
