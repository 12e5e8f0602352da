"""Put vertices that landed far off in the plane back among their neighbours."""

import numpy as np

from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_sides
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["without_strays"]

_LONGEST = 3.0  # an edge in the plane over the edge in space


def without_strays(V: Floats, F: Ints, uv: Floats) -> Floats:
    """Place strays at the mean of their neighbours.

    Where two sheets of a surface come close, a vertex may be taken for one of the other sheet. Edges
    that become much too long give it away: vertices stray that hang on the rest by such edges only.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm; itself where nothing strays
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.csgraph import connected_components
    from scipy.sparse.linalg import spsolve

    n = len(V)
    ab, ac, bc = _sound_sides(V, F, uv)
    if (ab & ac & bc).all():
        return uv
    bc &= ~(ab & ac)  # no need to join what hangs together
    rows = np.concatenate([F[ab, 0], F[ac, 0], F[bc, 1]])
    cols = np.concatenate([F[ab, 1], F[ac, 2], F[bc, 2]])
    _, part = connected_components(
        coo_matrix((np.ones(len(rows)), (rows, cols)), shape=(n, n)), directed=False
    )
    stray = part != np.bincount(part).argmax()
    if not stray.any():
        return uv
    E = edges(F).E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n)).tocsr()
    W = W + W.T
    L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[stray]
    placed = uv.copy()
    placed[stray] = spsolve(L[:, stray].tocsc(), -(L[:, ~stray] @ uv[~stray])).reshape(-1, 2)
    return placed


def _sound_sides(V: Floats, F: Ints, uv: Floats) -> tuple[Bools, Bools, Bools]:
    """Tell which sides of faces are not much too long: from corner 0 to 1, 0 to 2 and 1 to 2, (m,) each."""
    sound = np.empty((3, len(F)), bool)
    for (some, p, q), (_, d, e) in zip(face_sides(uv, F), face_sides(V, F), strict=True):
        flat, long = ([x, y, [b - a for a, b in zip(x, y, strict=True)]] for x, y in ((p, q), (d, e)))
        for k in range(3):
            sound[k, some] = sum(x * x for x in flat[k]) <= _LONGEST**2 * sum(x * x for x in long[k])
    return sound[0], sound[1], sound[2]
