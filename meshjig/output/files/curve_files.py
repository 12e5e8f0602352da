"""Curves as files: SVG for the plane, OBJ and DXF for space."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from meshjig.mesh.arrays import Floats

__all__ = ["Curves", "write_dxf", "write_obj_lines", "write_svg"]


@dataclass(frozen=True)
class Curves:
    """The cuts as polylines."""

    plane: list[Floats] = field(default_factory=list)  # each (k, 2), mm, in the charts' plane
    space: list[Floats] = field(default_factory=list)  # each (k, 3), mm


def write_svg(path: Path, curves: Sequence[Floats], line_mm: float = 0.2) -> None:
    """Write plane curves as SVG, true to size.

    Parameters
    ----------
    path : Path
    curves : sequence of (k, 2) float64, mm, y upward; a curve that ends where it began is closed
    line_mm : float, mm, width of the line
    """
    points = np.concatenate([np.empty((0, 2)), *curves])
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    width, height = high - low + 2 * line_mm
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.4f}mm" height="{height:.4f}mm" '
        f'viewBox="{low[0] - line_mm:.4f} {-high[1] - line_mm:.4f} {width:.4f} {height:.4f}">\n'
        f'<g fill="none" stroke="black" stroke-width="{line_mm:g}" stroke-linejoin="round">\n'
    )
    body = "".join(f'<path d="{_svg_path(curve)}"/>\n' for curve in curves if len(curve) > 1)
    path.write_text(head + body + "</g>\n</svg>\n", encoding="utf-8")


def write_obj_lines(path: Path, curves: Sequence[Floats]) -> None:
    """Write curves as the polylines (``l``) of an OBJ file.

    Parameters
    ----------
    path : Path
    curves : sequence of (k, 3) or (k, 2) float64, mm; closed as in ``write_svg``
    """
    lines = ["# meshjig, units: mm"]
    first = 1
    for curve in curves:
        closed = _is_closed(curve)
        points = _in_space(curve[:-1] if closed else curve)
        lines += ["v {:.9g} {:.9g} {:.9g}".format(*point) for point in points.tolist()]
        numbers = [*range(first, first + len(points)), *([first] if closed else [])]
        if len(numbers) > 1:
            lines.append("l " + " ".join(map(str, numbers)))
        first += len(points)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_dxf(path: Path, curves: Sequence[Floats]) -> None:
    """Write curves as 3D polylines of DXF release 12, which every CAD program reads.

    Parameters
    ----------
    path : Path
    curves : sequence of (k, 3) or (k, 2) float64, mm; closed as in ``write_svg``
    """
    tags: list[tuple[int, object]] = [(999, "meshjig, units: mm"), (0, "SECTION"), (2, "HEADER")]
    tags += [(9, "$ACADVER"), (1, "AC1009"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for curve in curves:
        closed = _is_closed(curve)
        points = _in_space(curve[:-1] if closed else curve)
        tags += [(0, "POLYLINE"), (8, "CUTS"), (66, 1), (10, 0.0), (20, 0.0), (30, 0.0), (70, 8 + closed)]
        for x, y, z in points.tolist():
            tags += [(0, "VERTEX"), (8, "CUTS"), (10, x), (20, y), (30, z), (70, 32)]
        tags += [(0, "SEQEND"), (8, "CUTS")]
    tags += [(0, "ENDSEC"), (0, "EOF")]
    text = "".join(
        f"{code}\n{value:.9g}\n" if isinstance(value, float) else f"{code}\n{value}\n" for code, value in tags
    )
    path.write_text(text, encoding="ascii")


def _is_closed(curve: Floats) -> bool:
    return len(curve) > 2 and bool((curve[0] == curve[-1]).all())


def _in_space(curve: Floats) -> Floats:
    return curve if curve.shape[1] == 3 else np.column_stack([curve, np.zeros(len(curve))])


def _svg_path(curve: Floats) -> str:
    closed = _is_closed(curve)
    points = (curve[:-1] if closed else curve) * (1, -1)  # the SVG's y runs downward
    return "M" + "L".join(f"{x:.4f} {y:.4f}" for x, y in points.tolist()) + ("Z" if closed else "")
