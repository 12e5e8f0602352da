"""Text can be printed and told apart."""

import pytest

from meshjig.errors import OptionError
from meshjig.extras.text import GLYPHS, reads_both_ways, text_outline

DIGITS = "0123456789"
WRITTEN = [character for character in GLYPHS if character != " "]
SIZES = [(5.0, 0.8), (4.0, 0.8), (3.0, 0.4)]


@pytest.mark.parametrize(("height", "stroke"), SIZES)
@pytest.mark.parametrize("character", [c for c in WRITTEN if c.isalnum()])
def test_capitals_and_digits_are_as_high_as_asked(character, height, stroke):
    low, high = text_outline(character + "2", height, stroke).bounds[1::2]
    assert high - low == pytest.approx(height, abs=0.03 * height)


@pytest.mark.parametrize(("height", "stroke"), SIZES)
def test_every_stroke_is_as_wide_as_the_pen(height, stroke):
    for part in text_outline(DIGITS, height, stroke).geoms:
        assert part.buffer(-0.4 * stroke).area > 0
        narrow = part.difference(part.buffer(-0.45 * stroke).buffer(0.5 * stroke))
        assert narrow.buffer(-0.05 * stroke).is_empty


@pytest.mark.parametrize(("height", "stroke"), SIZES)
def test_a_rib_of_the_pens_width_is_left_between_letters(height, stroke):
    parts = list(text_outline("1234567890", height, stroke).geoms)
    assert len(parts) == 10
    gaps = [a.distance(b) for i, a in enumerate(parts) for b in parts[:i]]
    assert min(gaps) > 0.93 * stroke


def test_no_two_digits_look_alike_upright_or_turned():
    import shapely.affinity

    shapes = {c: min(text_outline(c + "2", 5.0, 0.8).geoms, key=lambda part: part.bounds[0]) for c in DIGITS}
    for a in DIGITS:
        for b in DIGITS:
            for turned in (0, 180):
                if a == b or {a, b} == {"6", "9"}:
                    continue
                other = shapely.affinity.rotate(shapes[b], turned)
                (ax, ay), (bx, by) = ((s.centroid.x, s.centroid.y) for s in (shapes[a], other))
                other = shapely.affinity.translate(other, ax - bx, ay - by)
                assert shapes[a].symmetric_difference(other).area > 0.2 * shapes[a].area, (a, b)


@pytest.mark.parametrize("text", ["6", "9", "66", "68", "86", "89", "98", "99", "60", "09", "90", "600"])
def test_text_that_reads_as_another_when_turned_is_underlined(text):
    assert reads_both_ways(text)
    outline = text_outline(text, 5.0, 0.8)
    wide, low = outline.bounds[2] - outline.bounds[0], outline.bounds[1]
    lowest = outline.intersection(outline.envelope.buffer(0).intersection(_strip(outline, low, low + 0.4)))
    assert lowest.bounds[2] - lowest.bounds[0] == pytest.approx(wide, abs=0.1)


@pytest.mark.parametrize("text", ["0", "8", "69", "96", "88", "1", "16", "12", "100", "0.6", "-3"])
def test_text_that_has_one_reading_is_not_underlined(text):
    assert not reads_both_ways(text)
    low, high = text_outline(text + "2", 5.0, 0.8).bounds[1::2]
    assert high - low == pytest.approx(5.0, abs=0.1)


def test_text_that_cannot_be_written_is_refused():
    with pytest.raises(OptionError, match="can't be engraved"):
        text_outline("5µ", 5.0, 0.8)
    with pytest.raises(OptionError, match="can't be told apart"):
        text_outline("5", 2.0, 0.8)


def test_blanks_have_no_area():
    assert text_outline("  ", 5.0, 0.8).is_empty


def _strip(outline, low, high):
    import shapely

    return shapely.box(outline.bounds[0], low, outline.bounds[2], high)
