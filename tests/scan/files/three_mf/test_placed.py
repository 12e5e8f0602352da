"""What a 3MF package places is counted, wherever its objects stand."""

import zipfile

import pytest

from meshjig.errors import InputError
from meshjig.scan.files.three_mf import open_3mf
from meshjig.scan.files.three_mf.placed import faces_placed
from tests.scan.files.three_mf.build import MODEL, mesh, model, package, placed

REQUIRED = 'requiredextensions="p"'
OTHER = "3D/Objects/o.model"


def counted(path):
    with zipfile.ZipFile(path) as archive:
        return faces_placed(archive)


def in_another_file(folder, times):
    """Write objects, each twice the one before, in a file that stands after the one that places the last."""
    doubles = "".join(placed(k + 1, [f'objectid="{k}"'] * 2) for k in range(1, times + 1))
    outer = model(placed(1, [f'p:path="/{OTHER}" objectid="{times + 1}"']), required=REQUIRED)
    files = {OTHER: model(mesh(1) + doubles, "", required=REQUIRED)}
    return package(folder / "a.3mf", outer, files, [(OTHER, MODEL)])


def test_objects_in_other_files_are_counted_as_often_as_they_are_placed(tmp_path):
    assert counted(in_another_file(tmp_path, 5)) == (4 * 2**5, 7)
    with pytest.raises(InputError, match="faces together"):
        open_3mf(in_another_file(tmp_path, 30))


def test_where_nothing_is_to_be_built_what_is_no_part_of_others_counts(tmp_path):
    objects = mesh(1) + placed(2, ['objectid="1"'] * 3) + mesh(3)
    assert counted(package(tmp_path / "a.3mf", model(objects, "")))[0] == 16
    assert counted(package(tmp_path / "a.3mf", model(objects)))[0] == 4


def test_objects_within_themselves_end(tmp_path):
    objects = placed(1, ['objectid="2"']) + placed(2, ['objectid="1"'])
    assert counted(package(tmp_path / "a.3mf", model(objects)))[0] == 0
