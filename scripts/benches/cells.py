"""Cells: from a clean mesh to a labelled cut mesh, as a ratio to one LSCM a cell in the same run."""

import time
from pathlib import Path

import numpy as np

RUNS = (("nefertiti.obj", 100_000, 100), ("nefertiti.obj", 100_000, 1000))
GROWTH = (50_000, 200_000, 1_000_000)


def run(corpus: Path) -> None:
    """Print seconds by stage, and their sum over the sum of an LSCM of each cell."""
    from meshjig import read_scan

    print("\ncells, from clean mesh to labelled cut mesh: seconds by stage")
    for name, faces, n in RUNS:
        mesh = read_scan(corpus / name, size=150.0, faces=faces).mesh
        print(f"{name:16} {len(mesh.F):>8} faces {n:>5} pieces  {_row(mesh, n)}", flush=True)
    for faces in GROWTH:
        mesh = _vase(faces)
        print(f"{'vase':16} {len(mesh.F):>8} faces   100 pieces  {_row(mesh, 100)}", flush=True)


def _row(mesh, n: int) -> str:
    from meshjig.layout.cells import cell_layout
    from meshjig.options import Options
    from meshjig.runtime.progress import Stages, peak_memory_mb

    stages = Stages()
    start = time.perf_counter()
    layout = cell_layout(mesh, Options.of(pieces=n, process="sla"), stages)
    total = time.perf_counter() - start
    clock = _lscms(layout.atlas)
    parts = "  ".join(f"{stage} {seconds:.2f}" for stage, seconds in stages.seconds.items())
    return f"{parts}  total {total:.2f} s, {total / clock:.1f} times its LSCMs, {peak_memory_mb():.0f} MB"


def _lscms(atlas) -> float:
    """Time one LSCM for each cell, one after another."""
    import igl

    from meshjig.mesh.halfedges import border_halfedges, compact

    V, F = atlas.mesh.V, atlas.mesh.F
    seconds = 0.0
    for chart in range(atlas.n_charts):
        G, kept = compact(F[atlas.chart_of_face == chart])
        W = V[kept]
        rim = G.ravel()[border_halfedges(G)]
        pins = np.array([rim[0], rim[np.linalg.norm(W[rim] - W[rim[0]], axis=1).argmax()]])
        start = time.perf_counter()
        igl.lscm(W, G, pins, np.array([[0.0, 0.0], [1.0, 0.0]]))
        seconds += time.perf_counter() - start
    return seconds


def _vase(faces: int):
    from models.vases import vase

    from meshjig import Mesh

    rows = round((faces / 2 * 0.55) ** 0.5)
    made = vase(around=round(faces / 2 / rows), rows=rows)
    return Mesh(np.asarray(made.vertices, np.float64), np.asarray(made.faces, np.int64))
