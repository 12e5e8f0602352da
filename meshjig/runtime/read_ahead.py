"""A mesh file that is being read already, while what makes a puzzle of it is still imported."""

from __future__ import annotations

import os
from typing import Any

from meshjig.runtime.bounded import Bounded, OutOfBounds

__all__ = ["ReadAhead"]

_READER = "meshjig.scan.reading", "read_file"  # by name: to import it takes as long as to read


class ReadAhead:
    """A mesh file in place of its path.

    Parameters
    ----------
    path : path
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self._answer = Bounded(*_READER, self.path)

    def result(self) -> Any:
        """Wait for what the file holds.

        Returns
        -------
        meshjig.scan.reading.FileMesh

        Raises
        ------
        InputError
            What is wrong with the file.
        OutOfBounds
            Its reader crashed, or went beyond the limits of memory and time.
        """
        try:
            return self._answer.result()
        except OutOfBounds as error:
            if not error.crashed:
                raise
        return Bounded(*_READER, self.path, False).result()  # without the reader that crashes most
