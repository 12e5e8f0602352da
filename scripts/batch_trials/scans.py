"""Scans for trials: small sound ones, broken ones, and tilings that end the process they run in."""

import sys
from pathlib import Path

import numpy as np
import trimesh

FAULTS = '''
"""Tilings that end their process."""
import ctypes, os, time

def segfault(seed=0, columns=None):
    ctypes.string_at(0)

def abort(seed=0, columns=None):
    os.abort()

def killed(seed=0, columns=None):
    os.kill(os.getpid(), 9)

def hang(seed=0, columns=None):
    ctypes.PyDLL(None).sleep(100_000)  # without letting go of the interpreter

def hungry(seed=0, columns=None):
    held = []
    while len(held) < 20:
        held.append(bytearray(b"x") * 1_000_000_000)

def forks(seed=0, columns=None):
    for i in range(2):
        if os.fork() == 0:
            if i:
                os.setsid()
            while True:
                time.sleep(1)
    while True:
        time.sleep(1)
'''
NAMES = ("segfault", "abort", "killed", "hang", "hungry", "forks")


def install_faults(site: Path) -> None:
    """Write the package of tilings that misbehave, as pip would install it."""
    info = site / "meshjig_faults-1.dist-info"
    info.mkdir(parents=True)
    (site / "meshjig_faults.py").write_text(FAULTS)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: meshjig-faults\nVersion: 1\n")
    points = "".join(f"fault-{name} = meshjig_faults:{name}\n" for name in NAMES)
    (info / "entry_points.txt").write_text(f"[meshjig.tilings]\n{points}")


def sound_scans(folder: Path, n: int, faces: int = 320) -> list[Path]:
    """Write balls, boxes and rings, no two alike."""
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(0)
    paths = []
    for i in range(n):
        mesh = _shape(i, faces)
        mesh.apply_scale(random.uniform(0.8, 1.25, 3))
        path = folder / f"sound-{i:04d}{('.stl', '.ply', '.obj')[i % 3]}"
        mesh.export(path)
        paths.append(path)
    return paths


def _shape(i: int, faces: int) -> trimesh.Trimesh:
    if i % 3 == 1:
        return trimesh.creation.torus(30, 12, major_sections=24, minor_sections=max(8, faces // 48))
    if i % 3 == 2:
        return trimesh.creation.capsule(60, 20, count=[16, max(8, faces // 32)])
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=40)
    while len(mesh.faces) < 0.7 * faces:
        mesh = mesh.subdivide()
    return mesh


def broken_scans(folder: Path, n: int) -> list[Path]:
    """Write files that no mesh can be read of."""
    folder.mkdir(parents=True, exist_ok=True)
    good = trimesh.creation.icosphere(subdivisions=2)
    paths = []
    for i in range(n):
        path = folder / f"broken-{i:03d}.stl"
        data = good.export(file_type="stl")
        path.write_bytes([b"", data[: 100 + 37 * i], b"nonsense " * (i + 1), data[:84]][i % 4])
        paths.append(path)
    return paths


def command(*words: object) -> list[str]:
    """Give a command line of meshjig."""
    return [sys.executable, "-m", "meshjig", *map(str, words)]
