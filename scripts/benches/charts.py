"""Charts: how few, how true, how fast; xatlas beside them, and one LSCM of the same proxy as the clock."""

import time
from pathlib import Path

import numpy as np

MESHES = (
    "nefertiti.obj",
    "stanford-bunny.obj",
    "rocker-arm.obj",
    "fertility.off",
    "fandisk.obj",
    "camelhead.off",
)
LARGE = 1_000_000  # faces of the meshes that are made large and noisy
NOISE = 0.25  # of its edges' length


def run(corpus: Path) -> None:
    """Print a table, a mesh a line: charts and seam/sqrt(area) before and after zipping, and xatlas's own."""
    columns = f"{'mesh':18}{'charts':>14}{'seam':>14}{'gate':>8}{'flips':>6}{'s':>7}{'/lscm':>7}"
    print(f"\n{columns}   xatlas: charts, seam, gate, s")
    for name in MESHES:
        mesh = _scan(corpus / name)
        print(f"{name:18}{_row(mesh)}   {_of_xatlas(mesh)}", flush=True)
    for name in MESHES[:2]:
        print(f"{'noisy ' + name.split('.')[0]:18}{_row(_large(corpus / name))}", flush=True)


def _row(mesh) -> str:
    from meshjig import build_atlas

    seconds, clock = [], []
    for _ in range(3 if len(mesh.F) < LARGE / 2 else 1):
        start = time.perf_counter()
        atlas = build_atlas(mesh)
        seconds.append(time.perf_counter() - start)
        clock.append(_lscm(mesh))
    f, wall = atlas.facts, float(np.median(seconds))
    charts = f"{f['n_charts_before_zip']} -> {f['n_charts']}"
    seam = f"{f['seam_before_zip']:.1f} -> {f['seam_over_sqrt_area']:.1f}"
    ratio = wall / float(np.median(clock))
    return f"{charts:>14}{seam:>14}{f['gate_share']:>8.3f}{f['flips']:>6}{wall:>7.2f}{ratio:>7.0f}"


def _of_xatlas(mesh) -> str:
    from meshjig import build_atlas

    start = time.perf_counter()
    f = build_atlas(mesh, method="xatlas", zipped=False).facts
    seconds = time.perf_counter() - start
    return f"{f['n_charts']:>6} {f['seam_over_sqrt_area']:>5.1f} {f['gate_share']:.3f} {seconds:.1f}"


def _lscm(mesh) -> float:
    """Time one LSCM of the proxy that the charts are made on."""
    import igl

    from meshjig.charts.transfer.proxy import proxy_mesh

    W, G = proxy_mesh(mesh)
    far = np.array([0, np.linalg.norm(W - W[0], axis=1).argmax()])
    start = time.perf_counter()
    igl.lscm(W, G, far, np.array([[0.0, 0.0], [1.0, 0.0]]))
    return time.perf_counter() - start


def _scan(path: Path):
    from meshjig import read_scan

    return read_scan(path, size=150.0).mesh


def _large(path: Path):
    """Split every face of a light mesh in sixteen, and add noise along the normals."""
    import igl

    from meshjig import Mesh, read_scan
    from meshjig.mesh.halfedges import edges
    from meshjig.mesh.measure import vertex_normals

    mesh = read_scan(path, size=150.0, faces=LARGE // 16).mesh
    V, F = (np.ascontiguousarray(x) for x in igl.upsample(mesh.V, mesh.F, 2)[:2])
    F = F.astype(np.int64)
    E = edges(F).E
    step = float(np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1).mean())
    off = np.random.default_rng(0).normal(0, NOISE * step, len(V))
    return Mesh(V + off[:, None] * vertex_normals(V, F), F)
