"""One model of every option: library keywords, command-line flags and TOML keys are its fields."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError, model_validator

from meshjig.errors import OptionError

__all__ = ["PROCESSES", "Options"]

PROCESSES: dict[str, dict[str, float]] = {
    "fdm": {"thickness": 2.0, "clearance": 0.2, "min_neck": 2.0},
    "sla": {"thickness": 2.0, "clearance": 0.15, "min_neck": 0.5},
    "polyjet": {"thickness": 2.5, "clearance": 0.2, "min_neck": 0.5},
}


class Options(BaseModel):
    """How a puzzle is made.

    Lengths are in mm. Thickness, clearance and min_neck are the process's where they are not given.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    pieces: int = Field(100, ge=1, le=100_000, description="number of pieces to aim for")
    piece_size: FiniteFloat | None = Field(
        None, gt=0, description="edge of a piece, mm; takes the place of pieces"
    )
    size: FiniteFloat | None = Field(None, gt=0, description="largest extent of the model, mm")
    faces: Annotated[int, Field(ge=100)] | Literal["all"] = Field(
        100_000, description="working resolution in faces, or 'all'"
    )
    thickness: FiniteFloat = Field(2.0, gt=0, description="thickness of the pieces, mm")
    clearance: FiniteFloat = Field(0.2, ge=0, description="whole gap between two pieces, mm")
    min_neck: FiniteFloat = Field(2.0, ge=0, description="least width of a knob's neck, mm")
    clearance_method: Literal["stretch", "domain"] = Field("stretch", description="how the gap is laid out")
    process: Literal["fdm", "sla", "polyjet"] = Field("fdm", description="printing process, for defaults")
    layout: Literal["tiles"] = Field("tiles", description="how the surface is divided")
    tile: Literal["classic", "rectangular"] = Field("classic", description="shape of the knobs")
    charts: Literal["auto", "lscm", "arap", "slim", "xatlas"] = Field(
        "auto", description="how charts are made"
    )
    stitch: FiniteFloat = Field(
        0.3, ge=0, le=1, description="share of a border at which two tiles join over a seam"
    )
    cavities: bool = Field(False, description="also cut shells that lie inside the solid")
    seed: int = Field(0, ge=0, description="seed of everything random")
    format: tuple[Literal["stl", "3mf", "obj", "glb"], ...] = Field(
        ("stl", "3mf"), min_length=1, description="file formats to write, separated by commas"
    )
    curves: bool = Field(
        False, description="also write the cut curves: SVG in the plane, OBJ and DXF in space"
    )

    @model_validator(mode="before")
    @classmethod
    def _fill_from_process(cls, given: Any) -> Any:
        if not isinstance(given, dict):
            return given
        given = {k: v for k, v in given.items() if v is not None}
        if isinstance(given.get("format"), str):
            given["format"] = tuple(part.strip() for part in given["format"].split(",") if part.strip())
        process = given.get("process", "fdm")
        preset = PROCESSES.get(process, {}) if isinstance(process, str) else {}
        return {**preset, **given}

    @classmethod
    def of(cls, **given: Any) -> Options:
        """Make options from keywords.

        Raises
        ------
        OptionError
            A name is unknown or a value is out of range; the sentence names it.
        """
        try:
            return cls(**given)
        except ValidationError as error:
            first = error.errors()[0]
            name = ".".join(str(part) for part in first["loc"][:1]) or "options"
            raise OptionError(
                f"{name.replace('_', '-')}: {first['msg'][:1].lower()}{first['msg'][1:]}"
            ) from None
