"""Keep knobs clear of each other and of the edges around them."""

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["Surroundings", "surroundings"]


@dataclass(frozen=True)
class Surroundings:
    """Which edges are near enough to each other for a knob to matter; copies a period away are, too."""

    edge: Ints  # (p,)
    other: Ints  # (p,)
    moved: Floats  # (p, 2), mm, how far the other is moved to lie beside the edge
    bulge: Floats  # (e,), mm, how far each edge is bent off the straight line between its ends
    clearance: float  # mm, that there must be between a knob and anything else

    def hit(self, knobs: Floats, of_edge: Ints, drawn: Floats, knobbed: Bools, neck: slice) -> Bools:
        """Tell which knobs come too near to an edge or a knob, or to a knob listed before.

        Parameters
        ----------
        knobs : (k, n, 2) float64, mm, edges with a knob
        of_edge : (k,) int64, their edges
        drawn : (e, n, 2) float64, mm, all edges as they are drawn so far
        knobbed : (e,) bool, which of those have a knob
        neck : slice, the points of a knob

        Returns
        -------
        (k,) bool
        """
        row = np.full(len(drawn), -1)
        row[of_edge] = np.arange(len(of_edge))
        centre, radius = np.zeros((len(drawn), 2)), np.full(len(drawn), -np.inf)
        centre[knobbed], radius[knobbed] = _discs(drawn[knobbed][:, neck])
        new_centre, new_radius = _discs(knobs[:, neck])
        tried = np.flatnonzero(row[self.edge] >= 0)
        mine = row[self.edge[tried]]
        other, moved = self.other[tried], self.moved[tried]
        from_edge = _distance(new_centre[mine], drawn[other][:, [0, -1]] + moved[:, None])
        apart = np.linalg.norm(new_centre[mine] - centre[other] - moved, axis=1) - radius[other]
        near = np.minimum(from_edge - self.bulge[other], apart) < new_radius[mine] + self.clearance
        hit = np.zeros(len(knobs), bool)
        against = drawn[other[near]] + moved[near, None]
        hit[mine[near][self._near(knobs[mine[near]][:, neck], against)]] = True

        rival = row[other]
        rivals = (rival >= 0) & ~hit[mine] & ~hit[rival]
        apart = np.linalg.norm(new_centre[mine] - new_centre[rival] - moved, axis=1)
        rivals &= apart < new_radius[mine] + new_radius[rival] + self.clearance
        mine, rival, moved = mine[rivals], rival[rivals], moved[rivals]
        clash = self._near(knobs[mine][:, neck], knobs[rival][:, neck] + moved[:, None])
        for a, b in sorted(zip(mine[clash].tolist(), rival[clash].tolist(), strict=True)):
            if not hit[a] and not hit[b]:
                hit[max(a, b)] = True
        return hit

    def _near(self, one: Floats, other: Floats) -> Bools:
        import shapely

        if not len(one):
            return np.zeros(0, bool)
        near: Bools = shapely.dwithin(shapely.linestrings(one), shapely.linestrings(other), self.clearance)
        return near


def surroundings(drawn: Floats, clearance: float, period: float) -> Surroundings:
    """Pair edges (e, n, 2), mm, with those around them, and with copies a period away, if not 0."""
    from scipy.spatial import cKDTree

    middle = (drawn[:, 0] + drawn[:, -1]) / 2
    longest = float(np.linalg.norm(drawn[:, -1] - drawn[:, 0], axis=1).max(initial=0.0))
    tree = cKDTree(middle)
    edge, other, moved = [], [], []
    for turns in (-1, 0, 1) if period else (0,):
        by = np.array([turns * period, 0.0])
        near = tree.sparse_distance_matrix(cKDTree(middle + by), longest + clearance, output_type="ndarray")
        near = near[(near["i"] != near["j"]) | (turns != 0)]
        edge.append(near["i"].astype(np.int64))
        other.append(near["j"].astype(np.int64))
        moved.append(np.tile(by, (len(near), 1)))
    ends = np.repeat(drawn[:, None, [0, -1]], drawn.shape[1], axis=1).reshape(-1, 2, 2)
    bulge = _distance(drawn.reshape(-1, 2), ends).reshape(len(drawn), -1).max(1, initial=0.0)
    return Surroundings(np.concatenate(edge), np.concatenate(other), np.concatenate(moved), bulge, clearance)


def _discs(knobs: Floats) -> tuple[Floats, Floats]:
    """Enclose knobs (k, n, 2): centres (k, 2) and radii (k,)."""
    centre = (knobs.min(1) + knobs.max(1)) / 2
    return centre, np.linalg.norm(knobs - centre[:, None], axis=2).max(1, initial=0.0)


def _distance(points: Floats, ends: Floats) -> Floats:
    """The distance of points (k, 2) from segments (k, 2, 2)."""
    d, p = ends[:, 1] - ends[:, 0], points - ends[:, 0]
    t = np.einsum("ij,ij->i", p, d) / np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    return np.linalg.norm(p - np.clip(t, 0, 1)[:, None] * d, axis=1)
