"""What the report says of how solids and their gap were made."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshjig.mesh.arrays import Bools, Ints
from meshjig.mesh.measure import mesh_volume
from meshjig.solid.carve_gap import Carved

__all__ = ["KerfFacts", "kerf_facts"]


@dataclass(frozen=True)
class KerfFacts:
    """What the report says of how the solids and their gap were made; pieces by their number."""

    raised: int  # see SolidCounts
    pinches: int
    nudged: int
    shrunk: int
    segments: int  # quads of wall
    rounded: int  # joints too sharp for a miter
    hulls: int  # quads too twisted for a slab
    discarded_volume_share: float  # of what came off
    split: list[int]  # pieces that lost parts by that
    taken_apart: list[int]  # pieces whose slabs had to be
    mended: list[int]  # pieces whose folds had to be repaired
    crossing: list[int]  # pieces for which that failed
    uncut: list[int]

    def updated(self, newer: KerfFacts, made: Bools) -> KerfFacts:
        """Take in what is known of pieces that were made again, (p,) bool."""
        again = set(np.flatnonzero(made).tolist())

        def both(old: list[int], new: list[int]) -> list[int]:
            return sorted({*old} - again | {*new})

        return replace(
            self,
            discarded_volume_share=max(self.discarded_volume_share, newer.discarded_volume_share),
            split=both(self.split, newer.split),
            taken_apart=both(self.taken_apart, newer.taken_apart),
            mended=both(self.mended, newer.mended),
            crossing=both(self.crossing, newer.crossing),
            uncut=both(self.uncut, newer.uncut),
        )

    def renumbered(self, number: Ints) -> KerfFacts:
        """Give the same with other numbers of the pieces, (p,)."""

        def named(pieces: list[int]) -> list[int]:
            return sorted({int(number[i]) for i in pieces})

        return replace(
            self,
            split=named(self.split),
            taken_apart=named(self.taken_apart),
            mended=named(self.mended),
            crossing=named(self.crossing),
            uncut=named(self.uncut),
        )


def kerf_facts(counted: list[int], carved: dict[int, Carved]) -> KerfFacts:
    """Put together what was counted, in the order of the fields, and what became of each piece."""
    lost = sum(piece.lost for piece in carved.values())
    volume = sum(mesh_volume(piece.V, piece.F) for piece in carved.values())

    def those(state: str) -> list[int]:
        return sorted(i for i, piece in carved.items() if piece.state == state)

    raised, pinches, nudged, shrunk, segments, rounded, hulls = counted
    return KerfFacts(
        raised,
        pinches,
        nudged,
        shrunk,
        segments,
        rounded,
        hulls,
        discarded_volume_share=lost / max(lost + volume, 1e-300),
        split=sorted(i for i, piece in carved.items() if piece.parts),
        taken_apart=those("rounded"),
        mended=those("mended"),
        crossing=those("crosses"),
        uncut=those("uncut"),
    )
