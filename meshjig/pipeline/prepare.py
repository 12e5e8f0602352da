"""From a mesh to its charts: for a puzzle, or for whoever wants the atlas alone."""

from __future__ import annotations

import logging
import os
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Unpack

import numpy as np

from meshjig.charts import MappedAtlas, build_atlas
from meshjig.mesh.types import Bools, Mesh
from meshjig.options import OptionKeywords, Options
from meshjig.output.folder import replace_folder, reserve_folder
from meshjig.output.report import Report, write_report
from meshjig.pipeline.ground import limit_of
from meshjig.pipeline.preflight import checked_options, piece_size
from meshjig.pipeline.up import AUTO, up_axis
from meshjig.runtime.version import meshjig_version
from meshjig.scan import Floor, Preparation, Scan, read_scan
from meshjig.scan.fill import fill_holes
from meshjig.scan.notes import open_borders_note
from meshjig.scan.read import with_crossings
from meshjig.scan.thin_share import thin_shares

__all__ = ["atlas", "clean_scan", "describe_charts", "describe_model"]

told = logging.getLogger("meshjig.told")  # the command line shows it, unless it is to be quiet

KIND = "set of charts"  # what its folder holds
LEVEL = 0.01  # of the largest extent: how far off its plane a cut may be after the mesh was simplified
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
    options = checked_options(options, keywords)
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


def describe_model(mesh: Any, options: Options) -> Report:
    """Say what a mesh is, what would be done to it, and how much of it is thin.

    Parameters
    ----------
    mesh : path, ReadAhead, trimesh.Trimesh, or (V, F)
    options : Options

    Returns
    -------
    dict
        The fields of `ScanFacts`; "thin": {"through", "min_wall"}, fields of a `ThinShare` each: what would
        be cut through, and what is thinner than the least wall.
    """
    scan = read_scan(
        mesh,
        size=options.size,
        faces=options.faces,
        cavities=options.cavities,
        preparation=preparation(options),
    )
    limits = {"through": limit_of(options), "min_wall": options.min_wall}
    thin = thin_shares(scan.mesh, list(limits.values()))
    told = {name: share._asdict() for name, share in zip(limits, thin, strict=True)}
    return {**with_crossings(scan).as_dict(), "thin": told}


def chart(scan: Scan, options: Options) -> MappedAtlas:
    """Cut a clean surface into charts as the options say."""
    return build_atlas(
        scan.mesh, method=options.charts, seed=options.seed, source=scan.source, to_source=scan.to_source
    )


def clean_scan(mesh: Any, options: Options) -> Scan:
    """Read a mesh as the options ask, and close its small holes; say how large it is, and why."""
    scan = read_scan(
        mesh,
        size=options.size,
        faces=options.faces,
        cavities=options.cavities,
        resurface=options.resurface,
        preparation=preparation(options),
    )
    diameter = _widest_hole(scan.mesh, options) if options.fill_holes is None else options.fill_holes
    filled = fill_holes(scan.mesh.V, scan.mesh.F, diameter, _open_base(scan, options))
    size = " x ".join(f"{x:.4g}" for x in scan.facts.size_mm)
    told.info(f"size: {size} mm; {scan.facts.units}")
    notes = [*scan.facts.notes, *open_borders_note(filled.facts)]
    if scan.facts.floor and options.up == AUTO and scan.source.up is None:
        notes.append(
            "neither the file nor --up says which way is up: z was taken, along which it was cut off"
        )
    facts = replace(scan.facts, filled_holes=filled.facts, notes=notes)
    return replace(scan, mesh=Mesh(filled.V, filled.F), facts=facts)


def preparation(options: Options) -> Preparation:
    """Give what the options ask of a scan."""
    floor = None
    if options.drop_below is not None or options.flat_base is not None or options.open_base:
        height = options.drop_below if options.flat_base in (None, "auto") else options.flat_base
        floor = Floor(
            height if isinstance(height, float) else None,
            up=partial(up_axis, options.up),
            open=options.open_base,
            stands=options.flat_base is not None,
        )
    return Preparation(options.unit, options.keep, floor, options.clearance, options.memory)


def _open_base(scan: Scan, options: Options) -> Bools | None:
    """Mark the vertices of a base that stays open, (n,)."""
    if scan.facts.floor is None or not options.open_base:
        return None
    level = scan.mesh.V[:, "xyz".index(scan.facts.floor.axis)]
    return level < level.min() + LEVEL * float(np.ptp(scan.mesh.V, axis=0).max())


def _widest_hole(mesh: Mesh, options: Options) -> float:
    """Give the diameter, mm, up to which a hole would only be in a tile's way: half a tile."""
    return min(piece_size(mesh, options) / 2, WIDEST_HOLE * float(np.ptp(mesh.V, axis=0).max()))
