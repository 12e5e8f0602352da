"""A net that is made node by node and edge by edge, for a cap around a pole."""

from typing import Any

import numpy as np

from meshjig.mesh.types import Bools, Floats, Ints
from meshjig.tiling.graph import BESIDE
from meshjig.tiling.net import Net
from meshjig.tiling.poles.polar_bend import PolarBend

__all__ = ["PolarNet", "around_chart"]


class PolarNet:
    """Nodes and edges, made one by one.

    Labels of tiles that are the cap's own count from 0; a ring's tile k is -1 - k.
    """

    def __init__(self) -> None:
        self.nodes: list[Floats] = []
        self.ends: list[tuple[int, int]] = []
        self.sides: list[tuple[int, int]] = []
        self.may_have_knob: list[bool] = []
        self.n_own = 0
        self.bend = PolarBend(np.zeros(2), [])

    def node(self, at: Floats) -> int:
        """Add a node."""
        self.nodes.append(at)
        return len(self.nodes) - 1

    def edge(self, start: int, stop: int, left: int, right: int, knob: bool) -> None:
        """Add an edge."""
        self.ends.append((start, stop))
        self.sides.append((left, right))
        self.may_have_knob.append(knob)

    def own(self, n: int) -> list[int]:
        """Give n new tiles."""
        self.n_own += n
        return list(range(self.n_own - n, self.n_own))

    def net(self, ring_label: int) -> tuple[Net, Bools]:
        """Give the net, the ring's labels counted from a number, and which edges may have a knob."""
        sides = np.array(self.sides, np.int64)
        sides = np.where(sides < 0, ring_label - 1 - sides, sides)
        n, none = len(self.ends), np.zeros((len(self.ends), 2), np.int64)
        every: Ints = np.arange(n)
        return (
            Net(
                nodes=np.array(self.nodes),
                first_node=np.arange(len(self.nodes)),
                ends=np.array(self.ends, np.int64),
                left=sides[:, 0],
                right=sides[:, 1],
                kind=none[:, 0],
                copy=none,
                first_edge=every,
                turns=none[:, 0],
                n_tiles=self.n_own,
            ),
            np.array(self.may_have_knob),
        )


def around_chart(polygon: Any) -> PolarNet:
    """Draw a loop around a chart that is one tile: nothing is cut, but all of it has a label."""
    import shapely

    loop = shapely.get_coordinates(shapely.buffer(polygon, 0.6 * BESIDE).simplify(0.1 * BESIDE).exterior)
    made = PolarNet()
    tile, beyond = made.own(2)
    if not shapely.is_ccw(shapely.LinearRing(loop)):
        loop = loop[::-1]
    number = [made.node(at) for at in loop[:-1]]
    for a, b in zip(number, [*number[1:], number[0]], strict=True):
        made.edge(a, b, tile, beyond, knob=False)
    return made
