"""One model of every option: library keywords, command-line flags and TOML keys are its fields."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, TypedDict, Unpack, cast, get_args

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError, model_validator
from pydantic.fields import FieldInfo

from meshjig.errors import did_you_mean
from meshjig.option_errors import option_error, refused, shown_value, spelling

__all__ = ["EITHER", "PROCESSES", "OptionKeywords", "Options"]

Preset = dict[str, Any]

PROCESSES: dict[str, Preset] = {
    "fdm": {"thickness": 2.0, "clearance": 0.2, "min_neck": 2.0, "min_wall": 1.2, "give": 0.05},
    "sla": {"thickness": 2.0, "clearance": 0.15, "min_neck": 0.5, "min_wall": 0.8, "give": 0.0},
    "polyjet": {"thickness": 2.5, "clearance": 0.2, "min_neck": 0.5, "min_wall": 0.8, "give": 0.0},
    "foam": {"thickness": 7.0, "clearance": 0.2, "min_neck": 3.0, "min_wall": 3.0, "give": 1.0},
}


OF_TILES = {"angle", "charts", "pole", "random_style", "tile"}
OF_CELLS = {"crease_aware", "style"}
EITHER = {"pieces": "piece_size", "piece_size": "pieces"}  # who gives one takes back the other
LONGEST = 100_000.0  # mm
_MOST_SEED = 2**63 - 1


class OptionKeywords(TypedDict, total=False):
    """The fields of `Options` as keywords, for type checkers; None stands for what is not given."""

    pieces: int | None
    piece_size: float | None
    size: float | None
    unit: Literal["mm", "cm", "m", "inch", "auto"] | None
    keep: int | Literal["largest", "all"] | None
    drop_below: float | None
    flat_base: float | Literal["auto"] | None
    open_base: bool | None
    up: Literal["x", "y", "z", "auto"] | None
    faces: int | Literal["all"] | None
    thickness: float | None
    clearance: float | None
    min_neck: float | None
    min_wall: float | None
    give: float | None
    clearance_method: Literal["stretch", "domain", "solid"] | None
    join: Literal["miter", "round"] | None
    side: Literal["in", "out", "both"] | None
    through: float | Literal["auto", "off"] | None
    assembly: Literal["straight", "any", "off"] | None
    process: str | None
    resurface: bool | None
    layout: Literal["cells", "tiles"] | None
    style: Literal["cvt", "quad"] | None
    knob_size: float | None
    crease_aware: bool | None
    tile: str | None
    random: float | None
    random_style: Literal["bspline", "bilinear"] | None
    unique: bool | None
    min_piece: float | None
    charts: Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic", "uv"] | None
    pole: Literal["wedge", "capstone"] | None
    fill_holes: float | None
    angle: float | None
    stitch: float | None
    cavities: bool | None
    memory: float | None
    cores: int | None
    labels: bool | None
    core: bool | None
    seed: int | None
    format: str | Sequence[str] | None
    plate: str | None
    nest: Literal["fast", "tight"] | None
    explode: float | None
    viewer: bool | None
    guide: bool | None
    turntable: bool | None
    curves: bool | None
    processes: Mapping[str, Mapping[str, float]]  # of one's own: a name, and any of their five figures


class Options(BaseModel):
    """How a puzzle is made.

    Lengths are in mm. Thickness, clearance, min_neck, min_wall and give are the process's where they are not
    given. What a process of one's own leaves out is as for fdm.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    pieces: int = Field(100, ge=1, le=100_000, description="number of pieces to aim for")
    piece_size: FiniteFloat | None = Field(
        None, gt=0, le=LONGEST, description="edge of a piece, mm; in place of --pieces"
    )
    size: FiniteFloat | None = Field(
        None, gt=0, le=LONGEST, description="largest extent of the model, mm; goes before --unit"
    )
    unit: Literal["mm", "cm", "m", "inch", "auto"] = Field(
        "auto", description="unit of the file's numbers; auto: what the file says, else what is plausible"
    )
    keep: Annotated[int, Field(ge=1)] | Literal["largest", "all"] = Field(
        "all", description="connected parts to keep, by their area: largest, all, or how many"
    )
    drop_below: FiniteFloat | None = Field(
        None,
        gt=0,
        le=LONGEST,
        description="cut off what is less than this above the lowest point, mm, along --up",
    )
    flat_base: Annotated[FiniteFloat, Field(gt=0, le=LONGEST)] | Literal["auto"] | None = Field(
        None,
        description="as --drop-below, closed to a stand or refused; alone, or auto: at 3 % of the height",
        json_schema_extra={"alone": "auto"},
    )
    open_base: bool = Field(
        False, description="leave the cut of --drop-below or --flat-base open, as for a lamp"
    )
    up: Literal["x", "y", "z", "auto"] = Field(
        "auto", description="axis that points upward; auto: what the file says, else as the shape suggests"
    )
    faces: Annotated[int, Field(ge=100)] | Literal["all"] = Field(
        100_000, description="working resolution in faces, at least 100, or all of them"
    )
    thickness: FiniteFloat = Field(2.0, gt=0, le=LONGEST, description="thickness of the pieces, mm")
    clearance: FiniteFloat = Field(0.2, ge=0, le=LONGEST, description="whole gap between two pieces, mm")
    min_neck: FiniteFloat = Field(2.0, ge=0, le=LONGEST, description="least width of a knob's neck, mm")
    min_wall: FiniteFloat = Field(1.2, ge=0, le=LONGEST, description="least thickness that prints well, mm")
    give: FiniteFloat = Field(
        0.05, ge=0, le=LONGEST, description="how far pieces may press into each other as they go in, mm"
    )
    clearance_method: Literal["stretch", "domain", "solid"] = Field(
        "solid",
        description="how the gap is made: cut from the solids, or laid out in the plane (stretch, domain)",
    )
    join: Literal["miter", "round"] = Field("miter", description="how the inner sheet turns at creases")
    side: Literal["in", "out", "both"] = Field("in", description="where the thickness goes from the surface")
    through: Annotated[FiniteFloat, Field(gt=0, le=LONGEST)] | Literal["auto", "off"] = Field(
        "auto",
        description="cut through parts thinner than this, mm; auto: than two least walls and a gap",
    )
    assembly: Literal["straight", "any", "off"] = Field(
        "any",
        description="motions by which pieces must go in: straight ones, any, or off for walls along normals",
    )
    process: str = Field("fdm", description="how it is made: fdm, sla, polyjet, foam, or one from --config")
    resurface: bool = Field(False, description="rebuild the outer surface of a mesh that crosses itself")
    layout: Literal["cells", "tiles"] = Field(
        "cells",
        description="seam-free cells, or planar tiles on charts; an option of tiles asks for these",
    )
    style: Literal["cvt", "quad"] = Field("cvt", description="cells: spread evenly, or four-sided")
    knob_size: FiniteFloat = Field(
        1.0, gt=0, le=2, description="cells: size of the knobs, times the usual one, up to 2"
    )
    crease_aware: bool = Field(False, description="cells: keep cells and knobs off creases")
    tile: str = Field("classic", description="tiles: one that meshjig tiles lists, or FILE.svg")
    random: FiniteFloat = Field(0.0, ge=0, le=1, description="how far pieces and knobs differ, 0 to 1")
    random_style: Literal["bspline", "bilinear"] = Field(
        "bspline", description="tiles: bend them smoothly, or with kinks"
    )
    unique: bool = Field(False, description="let every piece fit in one place only")
    min_piece: FiniteFloat = Field(
        0.25, ge=0, le=1, description="share of the mean area below which a piece joins a neighbour"
    )
    charts: Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic", "uv"] = Field(
        "auto", description="tiles: how the surface is cut into charts and flattened"
    )
    pole: Literal["wedge", "capstone"] = Field(
        "capstone", description="how tiles close a ring's end: wedges that meet there, or one piece over it"
    )
    fill_holes: FiniteFloat | None = Field(
        None,
        ge=0,
        le=LONGEST,
        description="close holes up to this diameter, mm; half a tile if not given, 0 for none",
    )
    angle: FiniteFloat | None = Field(
        None,
        ge=-360,
        le=360,
        description="how far tiles are turned from a chart's long axis, degrees; chosen if not given",
    )
    stitch: FiniteFloat = Field(
        0.3, ge=0, le=1, description="share of a border at which two tiles join over a seam"
    )
    memory: FiniteFloat | None = Field(
        None, gt=0, description="limit of memory, GB: what would take more ends in a sentence"
    )
    cores: int | None = Field(
        None, ge=1, le=4096, description="cores to use; 1: no second process; all if not given"
    )
    cavities: bool = Field(False, description="also cut shells that lie inside the solid")
    labels: bool = Field(False, description="engrave the number of every piece where it is not seen")
    core: bool = Field(False, description="also make a core, on which the puzzle is built up")
    seed: int = Field(0, ge=0, le=_MOST_SEED, description="seed of everything random")
    format: tuple[Literal["stl", "ply", "3mf", "obj", "glb"], ...] = Field(
        ("stl", "3mf"), min_length=1, description="file formats to write, separated by commas"
    )
    plate: str | None = Field(
        None, description="also lay the pieces on plates: WIDTHxDEPTH in mm, or a printer such as prusa-mk4"
    )
    nest: Literal["fast", "tight"] = Field(
        "fast", description="how plates are packed; tight needs the package spyrrow"
    )
    explode: FiniteFloat = Field(
        0.6, ge=0, le=100, description="how far apart the exploded preview is, in distances from the middle"
    )
    viewer: bool = Field(True, description="write viewer.html")
    guide: bool = Field(True, description="write guide.pdf")
    turntable: bool = Field(False, description="also draw turntable.gif, the puzzle from all around")
    curves: bool = Field(
        False, description="also write the cut curves: SVG in the plane, OBJ and DXF in space"
    )

    @model_validator(mode="before")
    @classmethod
    def _fill_from_process(cls, given: Any) -> Any:
        if not isinstance(given, dict):
            return given
        given = {k: v for k, v in given.items() if v is not None}
        if isinstance(given.get("flat_base"), bool):
            given["flat_base"] = "auto" if given["flat_base"] else None
        if given.get("flat_base") is not None and given.get("drop_below") is not None:
            raise refused(
                "flat_base", "drop-below is given as well, a cut at the same place", "give one of them"
            )
        if isinstance(given.get("format"), str):
            given["format"] = tuple(part.strip() for part in given["format"].split(",") if part.strip())
        _refuse_contradictions(cls.model_fields, given)
        known = PROCESSES | _own_processes(given.pop("processes", {}))
        process = given.get("process", "fdm")
        if not isinstance(process, str) or process not in known:
            near = did_you_mean(process, known) if isinstance(process, str) else ""
            raise refused(
                "process", f"{shown_value(process)} is not known; known are {', '.join(known)}", near
            )
        return {**known[process], **given}

    @classmethod
    def of(cls, **given: Unpack[OptionKeywords]) -> Options:
        """Make options from keywords.

        Parameters
        ----------
        **given
            The fields; and ``processes``, a dict of processes of one's own: name to a dict with any of
            thickness, clearance, min_neck, min_wall and give.

        Raises
        ------
        OptionError
            A name is unknown or a value is out of range; the sentence names it.
        """
        try:
            return cls(**cast(Any, given))
        except ValidationError as error:
            raise option_error(error.errors(), cls.model_fields) from None


def _refuse_contradictions(fields: Mapping[str, FieldInfo], given: Preset) -> None:
    """Refuse truth where a number is needed, two ways of saying one thing, and options of the other layout.

    An option of tiles asks for them, where no layout is given.
    """
    for name in given.keys() & fields.keys():
        annotation = fields[name].annotation
        if isinstance(given[name], bool) and bool not in (annotation, *get_args(annotation)):
            says = f"{shown_value(given[name])} is no value for it"
            raise refused(name, says, "give another, or leave it out")
    if "pieces" in given and "piece_size" in given:
        says = "piece-size is given as well, and each of the two settles the other"
        raise refused("pieces", says, "give one of them")
    asking = sorted(given.keys() & OF_TILES)
    layout = given.get("layout", "tiles" if asking else "cells")
    other, foreign = {"cells": ("tiles", OF_TILES), "tiles": ("cells", OF_CELLS)}.get(str(layout), ("", ()))
    for name in sorted(given.keys() & set(foreign)):
        if given[name] != fields[name].default:
            why = "" if "layout" in given else f", which {spelling(asking[0])} asks for"
            says = f"this is for the layout of {other}, and the layout is {layout}{why}"
            raise refused(name, says, "leave out one of them")
    given["layout"] = layout


def _own_processes(tables: Any) -> dict[str, Preset]:
    """Give a user's processes, after checking that they are such."""
    keys = list(PROCESSES["fdm"])
    if not isinstance(tables, dict) or not all(isinstance(table, dict) for table in tables.values()):
        raise refused("processes", f"each is a table with any of {', '.join(keys)}")
    own = {
        name: {key.replace("-", "_"): value for key, value in table.items()} for name, table in tables.items()
    }
    for name, table in own.items():
        for key in sorted(set(table) - set(keys)):
            says = f"{name} sets {spelling(key)!r}; a process has {', '.join(keys)} only"
            raise refused("processes", says, did_you_mean(key, keys))
    return own
