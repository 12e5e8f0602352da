"""Pictures are read in a few formats only, told by their bytes; what is wrong with them is noted."""

import io
import os
import stat

import numpy as np
import pytest
from PIL import Image

from meshjig.scan.files.attachments import FORMATS, PictureReader
from meshjig.scan.load import load

GREEN = (20, 200, 40)
OBJ = "mtllib m.mtl\nv 0 0 0\nv 9 0 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"


def scan_with(folder, data, name="picture.png"):
    (folder / "m.mtl").write_text(f"newmtl m\nmap_Kd {name}\n")
    (folder / "m.obj").write_text(OBJ)
    (folder / name).write_bytes(data)
    read = load(folder / "m.obj")
    picture = read.source.look.picture
    return None if picture is None else Image.fromarray(picture), read.notes


def encoded(kind, size=(64, 64), colour=GREEN):
    buffer = io.BytesIO()
    Image.new("RGB", size, colour).save(buffer, kind)
    return buffer.getvalue()


@pytest.mark.parametrize("kind", FORMATS)
def test_each_format_is_told_by_its_bytes(tmp_path, kind):
    image, notes = scan_with(tmp_path, encoded(kind), "picture.any")
    assert np.abs(np.asarray(image)[30, 30].astype(int) - GREEN).max() < 12
    assert notes == []


def test_postscript_starts_nothing(tmp_path, monkeypatch):
    """Pillow would run Ghostscript, `gs`, on a picture that is none."""
    program = tmp_path / "bin/gs"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\ntouch {tmp_path}/was_run\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")
    image, [note] = scan_with(tmp_path, b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n{ } loop\n")
    assert not (tmp_path / "was_run").exists()
    assert min(image.size) <= 2 if image else True
    assert "picture.png is damaged, or none of PNG" in note


@pytest.mark.parametrize("kind", ["GIF", "PPM", "ICO"])
def test_other_formats_are_left_out(tmp_path, kind):
    _, [note] = scan_with(tmp_path, encoded(kind))
    assert "left out" in note


@pytest.mark.parametrize(
    "damage", [lambda data: data[: len(data) // 2], lambda data: data[:60] + b"x" + data[61:]]
)
def test_a_damaged_picture_is_left_out_and_noted(tmp_path, damage):
    noise = np.random.default_rng(0).integers(0, 255, (64, 64, 3), np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(noise).save(buffer, "PNG")
    image, [note] = scan_with(tmp_path, damage(buffer.getvalue()))
    assert image is None or min(image.size) <= 2
    assert note == "the picture picture.png is damaged: it is left out"


def test_a_large_photo_is_made_smaller(tmp_path):
    image, [note] = scan_with(tmp_path, encoded("JPEG", (12000, 300)))
    assert max(image.size) <= 8192
    assert "scaled from 12000 x 300" in note


def test_a_picture_of_nothing_that_unpacks_beyond_measure_is_left_out(tmp_path):
    _, [note] = scan_with(tmp_path, encoded("PNG", (15000, 15000), 0))
    assert "15000 x 15000 pixels in" in note


def test_the_library_is_as_before_afterwards():
    before = Image.open, Image.MAX_IMAGE_PIXELS
    with PictureReader().instead():
        assert Image.open != before[0]
    assert (Image.open, Image.MAX_IMAGE_PIXELS) == before


@pytest.mark.parametrize("mode", ["L", "LA", "P", "RGBA", "I;16", "CMYK", "1"])
def test_pictures_of_every_mode_become_what_a_screen_shows(mode):
    grey = np.tile(np.arange(0, 256, 4, dtype=np.uint8), (16, 1))
    if mode == "I;16":
        image = Image.fromarray((grey.astype(np.uint16) * 257).astype(np.uint16))
    elif mode == "RGBA":
        image = Image.fromarray(np.dstack([grey] * 3 + [255 - grey]))
    else:
        image = Image.fromarray(grey).convert("RGB" if mode == "CMYK" else "L").convert(mode)
    buffer = io.BytesIO()
    image.save(buffer, "TIFF" if mode == "CMYK" else "PNG")
    pixels = PictureReader().pixels(buffer.getvalue(), "p")
    expected = np.asarray(image.convert("L")) if mode == "1" else grey
    assert pixels.shape == (16, 64, 3)
    assert np.abs(pixels.astype(int) - expected[..., None]).max() <= 1


def test_pictures_share_the_room_there_is():
    reader = PictureReader()
    reader.expected = 200
    pixels = [reader.pixels(encoded("JPEG", (2000, 1000)), f"number {k}") for k in range(4)]
    assert sum(x.shape[0] * x.shape[1] for x in pixels) <= 4 * 2 * 8192**2 / 200
    assert reader.notes[0].startswith("the picture number 0 was scaled from 2000 x 1000 to")
