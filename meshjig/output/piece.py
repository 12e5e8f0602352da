"""What every writer is given: one named and coloured solid."""

from dataclasses import dataclass, field

from meshjig.mesh.types import Floats, Ints
from meshjig.output.texture import Coat

__all__ = ["Piece"]


@dataclass(frozen=True)
class Piece:
    """One solid in its assembled position.

    ``check.pieces`` judges solids; here they only have a name and a colour more.
    """

    name: str
    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    colour: tuple[float, float, float]  # red, green, blue as a screen shows them, 0 to 1
    coat: Coat | None = field(default=None, kw_only=True)  # where the scan had a picture
    outer_normal: Floats | None = field(default=None, kw_only=True)  # (3,), mean of the outer sheet, mm2
