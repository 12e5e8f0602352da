"""Prove motions twice: by meshjig.check.straight, and by the continuous collision detection of ipctk.

    scripts/motion_trial.py DIR [--motions 200] [--tilt 8] [--seed 0]

DIR is a puzzle that was made with a plan. The motions are those of the plan, and then others of pieces drawn
by chance, their way out tilted by up to --tilt degrees, so that many fail. Each takes a piece straight out of
all that is there before it, until it is clear. ipctk (`pip install ipctk`; meshjig itself doesn't need it)
moves the same two meshes by one linear step, with no least distance.

It prints how many motions each finds free and how many verdicts agree; then the others, each with its depth:
how far the piece's surface has to be drawn in or out for meshjig's verdict to be ipctk's, mm. 1 where there
are any.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from meshjig.check.assembly import smaller
from meshjig.check.straight import across, met_on_the_way
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.output.files.read_pieces import read_puzzle_files
from meshjig.output.report import read_expectations

try:
    import ipctk
except ImportError:
    sys.exit("This trial needs ipctk: pip install ipctk")

_DEPTHS = np.array([1e-3, 1e-2, 0.1, 1, 2, 5, 10, 20, 50, 100, 200, 500]) * 1e-3  # mm, that are tried
_CLEAR = 1.0  # mm, between both where a motion ends


class Trial(NamedTuple):
    """A motion, and what stays."""

    name: str
    tilted: float  # degrees off the planned way
    way: Floats  # (3,), unit
    moving: Mesh
    staying: Mesh


def main() -> int:
    a = _arguments()
    trials = list(_trials(a.folder, a.motions, a.tilt, np.random.default_rng(a.seed)))
    ours = [not met_on_the_way(t.moving, t.staying, t.way).points for t in trials]
    theirs = [_is_free(t) for t in trials]
    planned = sum(t.tilted == 0 for t in trials)
    other = [(t, one) for t, one, two in zip(trials, ours, theirs, strict=True) if one != two]
    print(f"{len(trials)} motions, {planned} of them planned: meshjig finds {sum(ours)} free, ", end="")
    print(f"ipctk {sum(theirs)}; {len(trials) - len(other)} verdicts agree")
    for t, free in other:
        said = "meshjig free, ipctk not" if free else "ipctk free, meshjig not"
        print(f"  {t.name}, {t.tilted:.2f} degrees off its way: {said}; depth {_depth(t, free)}")
    return 1 if other else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--motions", type=int, default=200)
    parser.add_argument("--tilt", type=float, default=8.0, help="degrees")
    parser.add_argument("--seed", type=int, default=0)
    return parser.parse_args()


def _trials(folder: Path, count: int, tilt: float, rng: np.random.Generator) -> Iterator[Trial]:
    pieces, _, report = read_puzzle_files([folder])
    plan = read_expectations(report, [name for name, _, _ in pieces]).assembly
    if plan is None:
        sys.exit(f"{folder} holds no plan: make it with --assembly any")
    solids = {name: Mesh(V, F) for name, V, F in pieces}
    order = list(plan["order"])
    asked = [(k, 0.0) for k in range(1, len(order))][:count]
    asked += [(int(rng.integers(1, len(order))), tilt * rng.random()) for _ in range(count - len(asked))]
    for k, off in asked:
        name = order[k]
        way = np.array(plan["way"][name]) / np.linalg.norm(plan["way"][name])
        x, y, _ = across(way)
        turn, lean = 2 * np.pi * rng.random(), np.radians(off)
        way = np.cos(lean) * way + np.sin(lean) * (np.cos(turn) * x + np.sin(turn) * y)
        V, F = solids[name]
        moving = Mesh(V + plan["shift"][name], F)
        yield Trial(name, off, way, moving, _beside(moving, [solids[q] for q in order[:k]], way))


def _beside(moving: Mesh, solids: list[Mesh], way: Floats) -> Mesh:
    """Give as one mesh those solids whose shadow along the way may meet that of what moves."""
    x = across(way)[:2].T
    low, high = (moving.V @ x).min(axis=0), (moving.V @ x).max(axis=0)
    shadows = [V @ x for V, _ in solids]
    near = [bool(((s.min(axis=0) <= high) & (s.max(axis=0) >= low)).all()) for s in shadows]
    V, F, _, _ = concatenate([solid for solid, is_near in zip(solids, near, strict=True) if is_near])
    return Mesh(V, F)


def _is_free(t: Trial) -> bool:
    """Tell what ipctk says; the way is upright, so that boxes around paths are slim."""
    if not len(t.staying.F):
        return True
    R = across(t.way).T
    moving, staying = t.moving.V @ R, t.staying.V @ R
    far = max(float(staying[:, 2].max() - moving[:, 2].min()), 0) + _CLEAR
    F: Ints = np.concatenate([t.moving.F, t.staying.F + len(moving)]).astype(np.int32)
    start = np.asfortranarray(np.concatenate([moving, staying]))
    end = start.copy(order="F")
    end[: len(moving), 2] += far
    mesh = ipctk.CollisionMesh(start, edges(F).E.astype(np.int32), F)
    side = np.repeat([0, 1], [len(moving), len(staying)]).astype(np.int32)
    mesh.can_collide = ipctk.make_vertex_patches_filter(side)
    return bool(ipctk.is_step_collision_free(mesh, start, end, 0.0))


def _depth(t: Trial, free: bool) -> str:
    """Tell how far a surface has to be moved for meshjig to find the contrary."""
    for depth in _DEPTHS.tolist():
        moved = smaller(t.moving, -depth if free else depth)
        if (not met_on_the_way(moved, t.staying, t.way).points) != free:
            return f"up to {depth:g} mm"
    return f"more than {_DEPTHS[-1]:g} mm"


if __name__ == "__main__":
    sys.exit(main())
