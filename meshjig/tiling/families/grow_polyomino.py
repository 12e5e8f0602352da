"""Grow polyominoes: squares of a torus merged until they are as few as asked."""

from numpy.random import Generator

__all__ = ["Cell", "grow"]

Cell = tuple[int, int]  # a square of the plane; on the torus it is the same as those a period away
Tiles = dict[int, list[Cell]]
Owner = dict[Cell, tuple[int, Cell]]  # of the torus's squares: the tile, and the square as it lists it

_LARGEST = 6  # squares; fewer than seven enclose no hole
_BESIDE = ((1, 0), (0, 1), (-1, 0), (0, -1))


def grow(columns: int, rows: int, n: int, rng: Generator) -> list[list[Cell]]:
    """Merge the squares of a torus into polyominoes of even size.

    The smallest polyomino joins its smallest neighbour, by chance among equals, as long as the two make
    no more than six squares and don't touch their own copies, a period away: so none encloses a hole
    and none goes around the torus.

    Parameters
    ----------
    columns, rows : int, squares around the torus
    n : int, polyominoes to stop at; there are more where the torus is too narrow to merge them
    rng : numpy Generator

    Returns
    -------
    list of list of (int, int)
        The squares of a polyomino, connected in the plane: some may lie outside of the torus's
        first period.
    """
    period = (columns, rows)
    tiles = {columns * j + i: [(i, j)] for j in range(rows) for i in range(columns)}
    owner = {cells[0]: (tile, cells[0]) for tile, cells in tiles.items()}
    while len(tiles) > n:
        pair = _next_pair(tiles, owner, period, rng)
        if pair is None:
            break
        kept, gone, moved = pair
        del tiles[gone]
        tiles[kept] += moved
        owner.update({(i % columns, j % rows): (kept, (i, j)) for i, j in moved})
    return list(tiles.values())


def _next_pair(
    tiles: Tiles, owner: Owner, period: Cell, rng: Generator
) -> tuple[int, int, list[Cell]] | None:
    """Choose a tile, one to join it, and where the latter's squares lie beside the former."""
    chance = dict(zip(tiles, rng.permutation(len(tiles)).tolist(), strict=True))
    for tile in sorted(tiles, key=lambda tile: (len(tiles[tile]), chance[tile])):
        choices = []
        for other, by in _neighbours(tiles[tile], owner, period):
            moved = [(i + by[0], j + by[1]) for i, j in tiles[other]]
            joined = tiles[tile] + moved
            if other != tile and len(joined) <= _LARGEST and _is_apart(joined, period):
                choices.append((len(moved), chance[other], other, moved))
        if choices:
            *_, other, moved = min(choices)
            return tile, other, moved
    return None


def _neighbours(cells: list[Cell], owner: Owner, period: Cell) -> set[tuple[int, Cell]]:
    """Give the tiles around, and how far their squares are moved to lie there."""
    found = set()
    for i, j in cells:
        for di, dj in _BESIDE:
            at = (i + di, j + dj)
            other, stored = owner[at[0] % period[0], at[1] % period[1]]
            found.add((other, (at[0] - stored[0], at[1] - stored[1])))
    return found


def _is_apart(cells: list[Cell], period: Cell) -> bool:
    """Tell whether no square touches a copy of another, by a side or at a corner."""
    own = set(cells)
    around = {(i + di, j + dj) for i, j in cells for di in (-1, 0, 1) for dj in (-1, 0, 1)} - own
    homes = {(i % period[0], j % period[1]) for i, j in own}
    return len(homes) == len(own) and not any((i % period[0], j % period[1]) in homes for i, j in around)
