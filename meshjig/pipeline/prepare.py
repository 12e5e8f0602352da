"""From a mesh to its charts: for a puzzle, or for whoever wants the atlas alone."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any, Unpack

import numpy as np

from meshjig.charts import MappedAtlas, build_atlas
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Mesh
from meshjig.options import OptionKeywords, Options
from meshjig.output.folder import replace_folder, reserve_folder
from meshjig.output.report import Report, write_report
from meshjig.pipeline.report import meshjig_version
from meshjig.scan import Scan, read_scan
from meshjig.scan.fill import fill_holes

__all__ = ["atlas", "clean_scan", "describe_charts"]

KIND = "set of charts"  # what its folder holds
WIDEST_HOLE = 0.1  # of the largest extent: few and large pieces must not close the rim of a vase


def atlas(mesh: Any, *, options: Options | None = None, **keywords: Unpack[OptionKeywords]) -> MappedAtlas:
    """Cut the surface of a mesh into few, large charts, and flatten them to the plane.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    options : Options, optional
        In place of keywords.
    **keywords
        The fields of `Options`; charts, size, faces, fill_holes, cavities and resurface matter here.

    Returns
    -------
    MappedAtlas
        In mm. Its facts are the gates that it was judged by.

    Raises
    ------
    MeshjigError
        One of its children; the sentence says what is wrong, where, and what to do.
    """
    options = options or Options.of(**keywords)
    return chart(clean_scan(mesh, options), options)


def describe_charts(mesh: Any, options: Options, folder: Path | None = None) -> Report:
    """Say how good the charts of a mesh are, and draw them where a folder is given.

    Parameters
    ----------
    mesh : path, trimesh.Trimesh, or (V, F)
    options : Options
    folder : Path
        Gets atlas.png and atlas.svg, and report.json; it appears whole or not at all.

    Returns
    -------
    dict, the atlas' facts
    """
    if folder is None:
        return dict(atlas(mesh, options=options).facts)
    from meshjig.output.pictures.atlas_sheet import draw_atlas

    inputs = [mesh] if isinstance(mesh, str | os.PathLike) else []
    with reserve_folder(folder, KIND, inputs):
        made = atlas(mesh, options=options)
        with replace_folder(folder, KIND) as scratch:
            draw_atlas(made, scratch)
            report = {"meshjig": meshjig_version(), "kind": KIND, "charts": made.facts}
            write_report(scratch / "report.json", report)
    return dict(made.facts)


def chart(scan: Scan, options: Options) -> MappedAtlas:
    """Cut a clean surface into charts as the options say."""
    return build_atlas(
        scan.mesh, method=options.charts, seed=options.seed, source=scan.source, to_source=scan.to_source
    )


def clean_scan(mesh: Any, options: Options) -> Scan:
    """Read a mesh, and close its small holes."""
    scan = read_scan(
        mesh,
        size=options.size,
        faces=options.faces,
        cavities=options.cavities,
        resurface=options.resurface,
    )
    diameter = _widest_hole(scan.mesh, options) if options.fill_holes is None else options.fill_holes
    filled = fill_holes(scan.mesh.V, scan.mesh.F, diameter)
    facts = replace(scan.facts, filled_holes=filled.facts)
    return replace(scan, mesh=Mesh(filled.V, filled.F), facts=facts)


def _widest_hole(mesh: Mesh, options: Options) -> float:
    """Give the diameter, mm, up to which a hole would only be in a tile's way: half a tile."""
    tile = options.piece_size or float(np.sqrt(face_areas(mesh.V, mesh.F).sum() / options.pieces))
    return min(tile / 2, WIDEST_HOLE * float(np.ptp(mesh.V, axis=0).max()))
