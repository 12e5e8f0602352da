"""A labelled surface that is planned to be put together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshjig.assembly import Plan, ShellRays, border_edges, needed_tilt, peel, room_to_lean, wall_directions
from meshjig.assembly.peel import Ban
from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Bools, Floats
from meshjig.mesh.measure import prism_volumes, sums, unit
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import Ground
from meshjig.pipeline.through import stock_of
from meshjig.solid import Shell
from meshjig.solid.kerf import Lean

__all__ = ["CutToAssemble", "knob_vertices"]

_SAME = 1e-6  # mm
_UPRIGHT = 8.0  # degrees of room that walls through thin parts have: they don't lean


class CutToAssemble:
    """What is cut, as it is labelled now."""

    def __init__(
        self,
        layout: Layout,
        ground: Ground,
        sheets: Shell,
        options: Options,
        on_knob: Bools,
        rays: ShellRays | None = None,
    ) -> None:
        self.layout, self.V = layout, layout.carried(sheets.outer[ground.vertex], layout.cut)
        self.F, self._asked = layout.cut.F, (ground, sheets, options, on_knob)
        self.deep, self.stock = stock_of(ground, layout, layout.cut, sheets, options.clearance)
        self.D = layout.carried(sheets.D[ground.vertex], layout.cut)
        self.piece = ground.labels(layout) if self.stock else layout.piece_of_face
        n = layout.stitching.n_pieces
        self.reaches = self.stock.reaches if self.stock else np.zeros(n, bool)
        frame = np.linalg.norm(self.D, axis=1)[:, None] * unit(self.deep)
        self.borders = border_edges(self.V, self.F, self.piece, frame, on_knob)
        self.rays = ShellRays(self.V, self.F, self.D) if rays is None else rays
        self._room = room_to_lean(self.borders, self.V, self.D, self.rays)
        self._set_upright(np.linalg.norm(self.deep - self.D, axis=1) > _SAME)
        if self.reaches.any():
            self.keep_upright(self.reaches)

    def beside(self, k: int) -> list[int]:
        """Name the neighbours of a piece."""
        pairs = self.borders.pairs[(self.borders.pairs == k).any(axis=1)]
        return [q for q in pairs.ravel().tolist() if q != k]

    def of(self, layout: Layout) -> CutToAssemble:
        """Give the same surface with other labels."""
        other = CutToAssemble(layout, *self._asked, self.rays)
        other._set_upright(other.upright | self.upright)
        return other

    def keep_upright(self, pieces: Bools) -> None:
        """Let no wall lean around some pieces, (p,)."""
        b = self.borders
        around = pieces[b.side].any(axis=1)
        upright = self.upright.copy()
        upright[np.concatenate([b.tail[around], b.head[around]])] = True
        self._set_upright(upright)

    def _set_upright(self, upright: Bools) -> None:
        b, self.upright = self.borders, upright
        room = self._room.copy()
        room[upright[b.tail] & upright[b.head]] = _UPRIGHT
        self.need = needed_tilt(b, room)

    def planned(self, up: Floats, bans: Sequence[Ban]) -> tuple[Plan, Lean]:
        """Give an order with a way out of each piece, and walls for it."""
        plan = peel(Mesh(self.V, self.F), self.piece, self.borders, self.need, up, bans)
        vertex, wall = wall_directions(self.borders, plan, self.V, self.D, self.upright, self.rays)
        return plan, Lean(vertex, wall, self.D)

    def laid_out(self, clearance: float) -> Floats:
        """Give the volume between the sheets of every piece, less half the gap along its borders, (p,), mm3.

        Not known of pieces that reach through thin parts: nan.
        """
        V, F, D, b = self.V, self.F, self.D, self.borders
        n, kept = len(self.reaches), self.piece >= 0
        whole = sums(self.piece[kept], prism_volumes(V, D, F[kept]), n)
        wall = b.length * np.linalg.norm(D[b.tail] + D[b.head], axis=1) / 2 * clearance / 2
        return np.where(self.reaches, np.nan, whole - sums(b.side.ravel(), np.repeat(wall, 2), n))


def knob_vertices(layout: Layout) -> Bools:
    """Mark the vertices of a cut that lie on the curves of knobs, (n,)."""
    cut = layout.cut
    n = max(int(cut.cut_segment.max(initial=-1)), int(layout.knobs.span.max(initial=0))) + 1
    segment, marked = np.zeros(n, bool), np.zeros(len(cut.V), bool)
    for first, after in layout.knobs.span.tolist():
        segment[first:after] = True
    marked[cut.cuts[segment[cut.cut_segment]].ravel()] = True
    return marked
