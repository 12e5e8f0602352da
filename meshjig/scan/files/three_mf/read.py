"""From a 3MF file to one mesh of all that it would have built, with what it shows."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.join import join
from meshjig.scan.files.three_mf.package import matrix_of, mesh_arrays, open_3mf, unit_of
from meshjig.scan.files.three_mf.properties import Properties
from meshjig.scan.files.three_mf.slicers import Leftout, left_out, mentions_paint
from meshjig.scan.source import Look, Source

__all__ = ["read_3mf_source"]


class _Placed(NamedTuple):
    """An object of the model, and where it is."""

    thing: Any  # lib3mf.Object
    matrix: Floats  # (4, 4), multiplies row vectors from the right
    within: int  # the number of the object that it is a component of, or its own


def read_3mf_source(path: Path, pictures: PictureReader) -> tuple[Source, list[str]]:
    """Read all that a 3MF file would have built, each object in its place.

    Parameters
    ----------
    path : Path
    pictures : PictureReader

    Returns
    -------
    source : Source
        In the unit that the file states, which is binding; z upward. Where nothing is to be built, all
        objects that are no components of others.
    notes : list of str, a sentence for everything that was left out

    Raises
    ------
    InputError
        As `open_3mf`; or lib3mf finds that an object is not as the standard has it.
    """
    import lib3mf

    notes: list[str] = []
    model = open_3mf(path, notes)
    try:
        with zipfile.ZipFile(path) as archive:
            source = _Reader(model, archive, pictures, notes).read()
    except lib3mf.ELib3MFException as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"{path} can't be read as 3MF ({reason})", hint="export it again") from None
    return source, [*notes, *pictures.notes]


class _Reader:
    """What is read of a file once, and placed perhaps many times."""

    def __init__(
        self, model: Any, archive: zipfile.ZipFile, pictures: PictureReader, notes: list[str]
    ) -> None:
        self._model, self._notes = model, notes
        self._properties = Properties(model, archive, pictures, notes)
        self._left_out: Leftout = left_out(archive)
        self._painted = mentions_paint(archive)
        self._read: dict[int, Source] = {}
        self._supports = self._helpers = self._others = 0
        self._seen: set[int] = set()
        self._unit = unit_of(model)
        pictures.expected = max(sum(1 for _ in _listed(model.GetTexture2Ds())), 1)

    def read(self) -> Source:
        parts = [self._placed(place) for place in self._built()]
        meshes = {mesh.GetUniqueResourceID() for mesh in _listed(self._model.GetMeshObjects())}
        counted = (
            (len(meshes - self._seen), "that the file does not have built"),
            (self._supports, "of support"),
            (self._helpers, "that a slicer's project has for modifiers or holes"),
            (self._others, "of beams or functions"),
        )
        self._notes += [f"left out: {n} object{'s' * (n > 1)} {what}" for n, what in counted if n]
        if self._painted:
            self._notes.append("colours painted in a slicer are left out: they are in a form of its own")
        return join(parts or [self._blank()])

    def _blank(self) -> Source:
        return Source(np.zeros((0, 3)), np.zeros((0, 3), np.int64), Look(), self._unit, "z")

    def _built(self) -> Iterator[_Placed]:
        """Every mesh that is to be built, through components."""
        waiting = [
            _Placed(item.GetObjectResource(), matrix_of(item.GetObjectTransform()), 0)
            for item in _listed(self._model.GetBuildItems())
        ]
        if not waiting:
            waiting = [_Placed(thing, np.eye(4), 0) for thing in self._loose()]
            if waiting:
                self._notes.append("the file says of no object that it is to be built: all were read")
        waiting.reverse()
        while waiting:
            thing, matrix, within = waiting.pop()
            self._seen.add(thing.GetUniqueResourceID())
            if self._is_extra(thing, within):
                continue
            if thing.IsMeshObject():
                yield _Placed(thing, matrix, within)
            elif thing.IsComponentsObject():
                number = thing.GetModelResourceID()
                for k in reversed(range(thing.GetComponentCount())):
                    part = thing.GetComponent(k)
                    place = matrix_of(part.GetTransform()) @ matrix
                    waiting.append(_Placed(part.GetObjectResource(), place, number))
            else:
                self._others += 1

    def _is_extra(self, thing: Any, within: int) -> bool:
        import lib3mf

        if thing.GetType() in (lib3mf.ObjectType.Support, lib3mf.ObjectType.SolidSupport):
            self._supports += 1
            return True
        if (within, thing.GetModelResourceID()) in self._left_out.parts:
            self._helpers += 1
            return True
        return False

    def _loose(self) -> list[Any]:
        """The objects that are no components of others."""
        things = list(_listed(self._model.GetObjects()))
        parts = {
            thing.GetComponent(k).GetObjectResource().GetUniqueResourceID()
            for thing in things
            if thing.IsComponentsObject()
            for k in range(thing.GetComponentCount())
        }
        return [thing for thing in things if thing.GetUniqueResourceID() not in parts]

    def _placed(self, place: _Placed) -> Source:
        key = place.thing.GetUniqueResourceID()
        if key not in self._read:
            self._read[key] = self._mesh(place.thing)
        mesh, matrix = self._read[key], place.matrix
        F, look = mesh.faces, mesh.look
        if np.linalg.det(matrix[:3, :3]) < 0:
            F, look = F[:, ::-1], look.turned()
        V = mesh.vertices
        if not np.array_equal(matrix, np.eye(4)):
            V = V @ matrix[:3, :3] + matrix[3, :3]
        return Source(V, F, look, self._unit, "z")

    def _mesh(self, thing: Any) -> Source:
        V, F = mesh_arrays(thing)
        look = self._properties.look(thing, len(F))
        if not len(F) and thing.BeamLattice().GetBeamCount():
            self._others += 1
        keep = np.ones(len(F), bool)
        for first, last in self._left_out.ranges.get(thing.GetModelResourceID(), ()):
            keep[first : last + 1] = False
            self._helpers += 1
        if not keep.all():
            F = F[keep]
            look = look.of(keep)
        return Source(V, F, look, self._unit, "z")


def _listed(iterator: Any) -> Iterator[Any]:
    while iterator.MoveNext():
        yield iterator.GetCurrent()
