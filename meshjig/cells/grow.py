"""Mesh to cells: equal-area geodesic power cells with smooth borders, each of them a disc."""

from typing import Literal

import numpy as np

from meshjig.cells.cell_mesh import CellMesh, Seeds
from meshjig.cells.extract import Extracted
from meshjig.cells.lloyd import Grown, evened, grown_again, grown_from, settled
from meshjig.cells.sample_seeds import four_sided, sample_seeds
from meshjig.cells.surface import Surface, surface
from meshjig.errors import CutError, OptionError
from meshjig.mesh.refinement import places
from meshjig.mesh.subdivide import refine
from meshjig.mesh.types import Floats, Ints, Mesh

__all__ = ["Style", "grow_cells"]

Style = Literal["cvt", "quad"]

_EDGE = 0.2  # of the spacing: edges longer than that are split
_BEND = 0.5  # spacings: what a radian of a crease adds to a path across it
_OFF = 0.02  # of the number of cells wanted: farther off than that, it is worth another try
_SMALLEST = 0.5  # of the mean area; so is a cell smaller than that
_TRIES = 3
_MANY = 0.06  # of the cells: with more pairs than that, another try does not help
_UNEVEN = 0.1  # of the seeds that a component deserves: a grid may miss them by that many


def grow_cells(
    mesh: Mesh,
    n: int,
    *,
    seed: int = 0,
    style: Style = "cvt",
    crease_aware: bool = False,
    off_ridges: float = 0.0,
    targets: Floats | None = None,
    start: Seeds | None = None,
) -> CellMesh:
    """Cut a surface into cells of equal area, each of them a disc, with smooth borders.

    Cells are geodesic power cells: a point belongs to the seed to which its squared distance less the
    seed's weight is least. Weights are such that every cell has the area asked for.

    Parameters
    ----------
    mesh : Mesh
        Any genus, open or closed, any number of components; they share the cells by area.
    n : int
        Cells wanted. There may be a few more on thin limbs and around holes, where a cell of the
        common area is no disc.
    seed : int
    style : str
        Where seeds are: "cvt" spreads them evenly.
    crease_aware : bool
        Let borders keep off creases, or follow them.
    off_ridges : float
        Let cells not reach over ridges: spacings that a radian of bend adds to a path across it.
    targets : (N,) float64, optional
        The areas of the cells relative to one another; with start.
    start : Seeds, optional
        Of an earlier result on the same mesh: its cells grow again, from the same places.

    Returns
    -------
    CellMesh

    Raises
    ------
    OptionError
        n is less than 1, or targets don't fit start.
    CutError
        Some cells can't be made discs; the message says where the first of them is.
    """
    if n < 1:
        raise OptionError(f"pieces: {n} is too few", hint="ask for at least 1")
    if targets is not None and (start is None or len(targets) != start.n_cells):
        raise OptionError("targets: there must be one for every cell of start", hint="give both")
    spacing = float(np.sqrt(mesh.areas.sum() / n))
    fine, parent = refine(mesh, _EDGE * spacing, shorter=False)
    s = surface(fine, max(_BEND if crease_aware else 0.0, off_ridges) * spacing)
    if start is not None:
        grown = grown_again(s, start, spacing, targets)
    elif style == "quad":
        grown = evened(s, grown_from(s, _on_all_components(s, four_sided(s, n), n, seed), spacing), spacing)
    else:
        grown = _of_about(s, n, spacing, seed)
    _refuse_what_is_no_disc(grown.extracted)
    cut = grown.extracted.cut
    parent = parent[cut.parent]
    made = Mesh(*cut.mesh)  # without what was kept of it
    return CellMesh(made, mesh, parent, *places(mesh, made, parent), cut.cell, grown.seeds, grown.facts(s))


def _of_about(s: Surface, n: int, spacing: float, seed: int) -> Grown:
    """Grow cells from seeds spread evenly; from others where they don't come out well."""
    tried: list[Grown] = []
    wanted = n
    for turn in range(_TRIES):
        seeds = settled(s, sample_seeds(s, wanted, seed + turn), spacing)
        grown = evened(s, grown_from(s, seeds, spacing), spacing)
        tried.append(grown)
        well = abs(grown.extracted.n - n) <= _OFF * n and grown.areas.min() >= _SMALLEST
        if well or len(grown.extracted.pairs) > _MANY * n:
            break
        if turn == _TRIES - 2:  # another draw does not help: so many fewer seeds
            wanted = max(n - min(abs(g.extracted.n - n) for g in tried), 1)
    return min(tried, key=lambda g: (g.n_bad, max(abs(g.extracted.n - n) - _OFF * n, 0.0), -g.areas.min()))


def _on_all_components(s: Surface, seeds: Ints, n: int, seed: int) -> Ints:
    """Put seeds that are spread evenly on components with too few or too many."""
    count, spread = np.bincount(s.component[seeds], minlength=len(s.closed)), sample_seeds(s, n, seed)
    share = np.bincount(s.component[spread], minlength=len(s.closed))
    off = np.abs(count - share) > _UNEVEN * share
    return np.union1d(seeds[~off[s.component[seeds]]], spread[off[s.component[spread]]])


def _refuse_what_is_no_disc(extracted: Extracted) -> None:
    bad, cut = np.flatnonzero(~extracted.good), extracted.cut
    if not len(bad):
        return
    middles = [
        cut.mesh.V[cut.mesh.F[cut.cell == cell]].mean((0, 1)) for cell in bad if (cut.cell == cell).any()
    ]
    where = f", the first around ({', '.join(f'{x:.0f}' for x in middles[0])}) mm" if middles else ""
    raise CutError(
        f"{len(bad)} of {extracted.n} pieces would be rings, or worse{where}",
        hint="smooth the surface there in a mesh editor",
        ids=bad.tolist(),
    )
