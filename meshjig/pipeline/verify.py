"""The verdict on finished pieces; those that stand too near to each other are mended and judged again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshjig.check import Verdict, judge
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.types import Floats, Ints
from meshjig.options import Options
from meshjig.solid import keep_apart
from meshjig.solid.printable import printable

__all__ = ["judged"]

Solid = tuple[Floats, Ints]


def judged(
    solids: list[Solid], names: Sequence[str], neighbours: Ints, options: Options, exempt: Sequence[str]
) -> tuple[list[Solid], Verdict, dict[str, Any]]:
    """Judge the pieces of a puzzle, and dent those that are nearer to a neighbour than the gap.

    Walls that cross, or sheets of a thin limb that face each other, leave such places where no wall's slab
    reaches. They are rare, and the verdict is what finds them.

    Parameters
    ----------
    solids : list of (V, F), the pieces in order
    names : their names
    neighbours : (k, 2) int64, pieces that face each other
    options : Options
    exempt : names of pieces that the surface's own crossings touch

    Returns
    -------
    solids : list of (V, F)
    verdict : Verdict
    facts : dict
        "dented": the numbers of pieces that have changed; "discarded": the share of the volume that came off.
    """
    verdict = _verdict(solids, names, neighbours, options, exempt)
    if not verdict.near or options.clearance_method != "solid":
        return solids, verdict, {"dented": [], "discarded": 0.0}
    near = np.array(verdict.near)
    changed = keep_apart({i: solids[i] for i in np.unique(near).tolist()}, near, options.clearance)
    if not changed:
        return solids, verdict, {"dented": [], "discarded": 0.0}
    mended = [printable(*changed[i][:2]) if i in changed else solid for i, solid in enumerate(solids)]
    lost = sum(gone for _, _, gone in changed.values())
    volume = sum(mesh_volume(V, F) for V, F in mended)
    facts = {"dented": sorted(changed), "discarded": lost / max(lost + volume, 1e-300)}
    return mended, _verdict(mended, names, neighbours, options, exempt), facts


def _verdict(
    solids: list[Solid], names: Sequence[str], neighbours: Ints, options: Options, exempt: Sequence[str]
) -> Verdict:
    return judge(
        [(name, V, F) for name, (V, F) in zip(names, solids, strict=True)],
        neighbours=neighbours.tolist(),
        thickness=options.thickness,
        clearance=options.clearance,
        min_wall=options.min_wall,
        exempt_pieces=exempt,
    )
