"""Extensions that a 3MF file requires and that are not known are named."""

import pytest

from meshjig.errors import InputError
from meshjig.scan.files.three_mf import open_3mf
from tests.scan.files.three_mf.build import mesh, model, package

OTHER = "http://schemas.3mf.io/3dmanufacturing/displacement/2023/10"


def test_an_extension_that_is_required_and_unknown_is_named(tmp_path):
    path = package(tmp_path / "a.3mf", model(mesh(1), required=f'xmlns:d="{OTHER}" requiredextensions="m d"'))
    with pytest.raises(InputError, match=f"needs {OTHER}") as caught:
        open_3mf(path)
    assert "without that extension" in caught.value.hint


@pytest.mark.parametrize("required", [f'xmlns:d="{OTHER}"', 'requiredextensions="m p"', ""])
def test_others_are_no_hindrance(tmp_path, required):
    model_ = open_3mf(package(tmp_path / "a.3mf", model(mesh(1), required=required)))
    assert model_.GetMeshObjects().Count() == 1
