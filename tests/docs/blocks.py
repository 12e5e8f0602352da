"""The code blocks of the documentation, and how they are run."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parent.parent.parent
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
_FENCE = re.compile(r"^```(?P<info>[^\n]*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
_COUNT = re.compile(r"(--pieces |\bpieces=)(\d+)")
_FEW = 8  # pieces are enough here, whatever a page asks for


class Block(NamedTuple):
    """A block of code."""

    language: str
    text: str
    file: str  # its caption, where it has one


def blocks(page: Path) -> list[Block]:
    """List the blocks of a page."""
    found = []
    for match in _FENCE.finditer(page.read_text(encoding="utf-8")):
        info, text = match["info"].strip(), match["text"]
        caption = re.match(r":caption: (.*)\n+", text)
        if caption:
            text = text[caption.end() :]
        found.append(Block(info.removeprefix("{code-block}").strip(), text, caption[1] if caption else ""))
    return found


def lines(text: str) -> list[str]:
    """List the commands of a block, without comments."""
    return [line.split("  #")[0].strip() for line in text.splitlines() if line.split("#")[0].strip()]


def fewer(code: str) -> str:
    """Ask for few pieces."""
    return _COUNT.sub(lambda m: m[1] + str(min(int(m[2]), _FEW)), code)


def run(words: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder, where ``meshjig`` is this checkout's."""
    path = os.pathsep.join([str(folder / "bin"), os.environ["PATH"]])
    python = os.pathsep.join([str(ROOT), str(folder / "site")])
    env = os.environ | {"PATH": path, "PYTHONPATH": python}
    return subprocess.run(words, capture_output=True, encoding="utf-8", cwd=folder, env=env, check=False)


def shim(folder: Path) -> None:
    """Put the command ``meshjig`` of this checkout into a folder."""
    (folder / "bin").mkdir()
    command = folder / "bin" / "meshjig"
    start = "import os, sys; sys.path[:0] = os.environ['PYTHONPATH'].split(os.pathsep); "
    command.write_text(
        f'#!/bin/sh\nexec "{sys.executable}" -c "{start}from meshjig.__main__ import main; main()" "$@"\n'
    )
    command.chmod(0o755)
