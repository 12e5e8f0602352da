"""The pictures of the stages: one each, of what the stage has made, and nobody's files in their way."""

import numpy as np
import pytest
from PIL import Image

import meshjig
from meshjig.pipeline.debug_pictures import STAGES, StagePictures
from tests.meshes import sphere


@pytest.mark.parametrize(("layout", "assembly"), [("cells", "any"), ("tiles", "off")])
def test_each_stage_has_its_picture(tmp_path, layout, assembly):
    folder = tmp_path / "new" / "stages"
    meshjig.make_puzzle(sphere(600), pieces=6, layout=layout, assembly=assembly, debug_dir=folder)
    assert sorted(path.name for path in folder.iterdir()) == sorted(STAGES)
    for name in STAGES:
        image = np.asarray(Image.open(folder / name).convert("RGB"))
        halves = np.hsplit(image, 2)
        assert image.shape[1] == 2 * image.shape[0]
        assert all((half < 250).any(2).mean() > 0.05 for half in halves), name
        assert (halves[0] != halves[1]).any(), name


def test_a_stage_that_fails_leaves_the_pictures_before_it(tmp_path):
    with pytest.raises(meshjig.MeshjigError):
        meshjig.make_puzzle(sphere(600), pieces=1, layout="tiles", charts="single", debug_dir=tmp_path)
    assert STAGES[0] in {path.name for path in tmp_path.iterdir()}


def test_a_folder_with_something_else_is_refused(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(meshjig.OutputError, match="something else"):
        StagePictures(tmp_path)
    with pytest.raises(meshjig.OutputError, match=r"can't be written.*--debug-dir"):
        StagePictures(tmp_path / "mine.txt")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
