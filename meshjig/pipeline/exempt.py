"""What to say, and to advise, where pieces are exempt because the model crosses itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshjig.errors import InputError
from meshjig.options import Options
from meshjig.scan import Scan, resurface
from meshjig.scan.resurface import resurfacing_cell

__all__ = ["exempt_note"]


def exempt_note(scan: Scan, options: Options, exempt: Mapping[str, Sequence[str]]) -> list[str]:
    """Say how many pieces break promises because the model crosses itself, and what helps.

    Resurfacing is advised where it works, which is tried.

    Parameters
    ----------
    scan : Scan
    options : Options
    exempt : mapping of a promise to the names of exempt pieces that break it

    Returns
    -------
    list of str, one sentence, or none where no piece does
    """
    n = len({name for names in exempt.values() for name in names})
    if not n:
        return []
    one = n == 1
    told = f"the mesh crosses itself, and so {'does 1 piece' if one else f'do {n} pieces'}: "
    if options.resurface:
        return [told + "larger --faces resolve more of it, or repair the mesh in an editor, such as Blender"]
    if _can_be_resurfaced(scan, options):
        return [told + "--resurface rebuilds its surface"]
    return [
        told + "it is too open for --resurface, so join its parts in a mesh editor, such as Blender "
        "(boolean union), or close its holes"
    ]


def _can_be_resurfaced(scan: Scan, options: Options) -> bool:
    V, F = scan.mesh
    try:
        resurface(V, F, resurfacing_cell(V, F, options.faces), cavities=options.cavities)
    except InputError:
        return False
    return True
