"""The verdict on finished pieces; those that stand too near to each other are mended and judged again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshjig.check import ThinParts, Verdict, judge
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.solid import enforce_gap
from meshjig.solid.printable import printable

__all__ = ["Mended", "verify"]


@dataclass(frozen=True)
class Mended:
    """What was done to pieces that stood too near to each other."""

    dented: list[int] = field(default_factory=list)  # pieces that have changed, by their number
    discarded_volume_share: float = 0.0  # of all pieces


def verify(
    pieces: Pieces, options: Options, exempt: Sequence[str], thin_parts: ThinParts | None = None
) -> tuple[Pieces, Verdict, Mended]:
    """Judge the pieces of a puzzle, and dent those that are nearer to a neighbour than the gap.

    Walls that cross, or sheets of a thin limb that face each other, leave such places where no wall's slab
    reaches. They are rare, and the verdict is what finds them.

    Parameters
    ----------
    pieces : Pieces, with their neighbours
    options : Options
    exempt : names of pieces that the surface's own crossings touch
    thin_parts : ThinParts, what is known of where the model is thin

    Returns
    -------
    pieces : Pieces
    verdict : Verdict
    mended : Mended
    """
    verdict = _verdict(pieces, options, exempt, thin_parts)
    if not verdict.near or options.clearance_method != "solid":
        return pieces, verdict, Mended()
    near = np.array(verdict.near)
    changed = enforce_gap({i: pieces[i] for i in np.unique(near).tolist()}, near, options.clearance)
    if not changed:
        return pieces, verdict, Mended()
    made = [printable(*changed[i][:2]) if i in changed else solid for i, solid in enumerate(pieces)]
    mended = pieces.with_solids(made)
    lost = sum(gone for _, _, gone in changed.values())
    volume = sum(mesh_volume(V, F) for V, F in mended)
    facts = Mended(sorted(changed), lost / max(lost + volume, 1e-300))
    return mended, _verdict(mended, options, exempt, thin_parts), facts


def _verdict(
    pieces: Pieces, options: Options, exempt: Sequence[str], thin_parts: ThinParts | None
) -> Verdict:
    return judge(
        replace(pieces),  # what is worked out of them for the verdict is not kept
        thickness=options.thickness,
        clearance=options.clearance,
        min_wall=options.min_wall,
        exempt_pieces=exempt,
        thin_parts=thin_parts,
    )
