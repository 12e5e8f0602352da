"""Modifiers and holes of slicers' projects are no parts of the model, and paint is named."""

from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.three_mf import read_3mf_source
from tests.scan.files.three_mf.build import FACES, mesh, model, package, placed

BAMBU = """<?xml version="1.0"?><config><object id="3"><part id="1" subtype="normal_part"></part>
<part id="2" subtype="{}"></part></object></config>"""
PRUSA = """<?xml version="1.0"?><config><object id="1"><volume firstid="0" lastid="3">
<metadata type="volume" key="volume_type" value="ModelPart"/></volume><volume firstid="4" lastid="7">
<metadata type="volume" key="volume_type" value="{}"/></volume></object></config>"""


def read(path, text, **files):
    return read_3mf_source(package(path / "a.3mf", text, files), PictureReader())


def test_a_component_that_is_a_modifier_is_left_out(tmp_path):
    text = model(mesh(1) + mesh(2) + placed(3, ['objectid="1"', 'objectid="2"']), '<item objectid="3"/>')
    name = "Metadata/model_settings.config"
    assert len(read(tmp_path, text, **{name: BAMBU.format("normal_part")})[0].faces) == 8
    source, [note] = read(tmp_path, text, **{name: BAMBU.format("negative_part")})
    assert len(source.faces) == 4
    assert note.startswith("left out: 1 object that a slicer's project has")


def test_triangles_that_are_a_modifier_are_left_out(tmp_path):
    text = model(mesh(1, faces=[*FACES, *FACES]))
    name = "Metadata/Slic3r_PE_model.config"
    assert len(read(tmp_path, text, **{name: PRUSA.format("ModelPart")})[0].faces) == 8
    source, [note] = read(tmp_path, text, **{name: PRUSA.format("ParameterModifier")})
    assert len(source.faces) == 4
    assert note.startswith("left out: 1 object that a slicer's project has")


def test_paint_is_named(tmp_path):
    for word in ('paint_color="4"', 'slic3rpe:mmu_segmentation="4"'):
        source, [note] = read(tmp_path, model(mesh(1, properties=[word, "", "", ""])))
        assert len(source.faces) == 4
        assert "painted in a slicer" in note


def test_a_damaged_project_is_read_as_a_plain_file(tmp_path):
    source, _ = read(tmp_path, model(mesh(1)), **{"Metadata/model_settings.config": "<config><obj"})
    assert len(source.faces) == 4
