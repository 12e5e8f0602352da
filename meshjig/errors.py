"""What can go wrong, as types.

::

    MeshjigError            everything below; its text is one sentence for a person
    |-- InputError          the mesh can't be read, or is no surface
    |-- OptionError         an option is out of range, or two of them contradict
    |-- ChartError          a chart can't be flattened
    |-- CutError            the surface can't be cut as asked
    |-- SolidError          a piece can't be given its thickness
    |-- OutputError         the result can't be written
    `-- ResourceError       the machine, or a limit given, has too little memory, disk or time
"""

__all__ = [
    "ChartError",
    "CutError",
    "InputError",
    "MeshjigError",
    "OptionError",
    "OutputError",
    "ResourceError",
    "SolidError",
]


class MeshjigError(Exception):
    """A failure that meshjig understands.

    Parameters
    ----------
    message : str
        What is wrong, and where.
    hint : str
        What to do about it; follows the message in the printed sentence.
    ids : list of int
        Faces, charts or pieces that the message is about.
    """

    stage = "meshjig"

    def __init__(self, message: str, *, hint: str = "", ids: list[int] | None = None) -> None:
        super().__init__(f"{message}: {hint}" if hint else message)
        self.message = message
        self.hint = hint
        self.ids = ids or []


class InputError(MeshjigError):
    """The mesh can't be read, or is no surface."""

    stage = "scan"


class OptionError(MeshjigError, ValueError):
    """An option is out of range, or two of them contradict."""

    stage = "options"


class ChartError(MeshjigError):
    """A chart can't be flattened."""

    stage = "charts"


class CutError(MeshjigError):
    """The surface can't be cut as asked."""

    stage = "cut"


class SolidError(MeshjigError):
    """A piece can't be given its thickness."""

    stage = "solid"


class OutputError(MeshjigError):
    """The result can't be written."""

    stage = "output"


class ResourceError(MeshjigError):
    """The machine, or a limit that was given, has too little memory, disk or time."""

    stage = "resources"
