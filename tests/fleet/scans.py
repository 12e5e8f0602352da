"""Scans and tasks for tests of batches: small ones, and commands in place of meshjig make."""

from __future__ import annotations

import trimesh

import meshjig
from meshjig.fleet.record import Marks, Record
from meshjig.fleet.task import Task, Terms
from tests.meshes import sphere

QUICK = {"pieces": 4, "viewer": False, "guide": False, "format": "stl"}


def write_ball(path, faces=300, scale=1.0):
    """Write a ball."""
    path.parent.mkdir(parents=True, exist_ok=True)
    V, F = sphere(faces)
    trimesh.Trimesh(V * scale, F, process=False).export(path)
    return path


def task(source, out, name="scan", **more):
    """Ask for a scan."""
    terms = Terms(str(out), meshjig.__version__, more.pop("seconds", 120.0), more.pop("memory", 4.0))
    return Task(name, str(source), {**QUICK, **more.pop("given", {})}, terms, **more)


def made(name, **more):
    """Give the record of a scan that was made."""
    facts = {"outcome": "made", "exit": 0, "pieces": 4, "size_mm": (1.0, 2.0, 3.0), "faces": 12}
    facts["marks"] = Marks("i", "o", "v")
    return Record(name, f"/in/{name}.stl", **(facts | more))


def failed(name, **more):
    """Give the record of a scan that failed."""
    facts = {"kind": "input", "message": f"{name} is empty", "hint": "export it again", "exit": 4}
    return Record(name, f"/in/{name}.stl", "failed", **(facts | more))
