"""Names in any script."""

import pytest

from meshjig.output.guide.latin import latin


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("模型-Ελλάδα-кот", "MoXing-Ellada-kot"),
        ("שלום", "slvm"),
        ("مرحبا", "mrhb"),
        ("Müller’s œuvre – 5 €", "Müller’s œuvre – 5 €"),
        ("e\u0301te\u0301", "été"),  # as macOS writes file names
        ("ведмідь é", "vedmid' é"),
        ("\ue000x", "U+E000x"),
        ("a\u200d\u0331b", "ab"),
        ("\u200d", "?"),
        ("\udcff", "U+DCFF"),  # a byte of a file name that is no UTF-8
    ],
)
def test_a_name_is_written_as_it_sounds_with_the_letters_of_every_pdf_reader(name, written):
    assert latin(name) == written
    assert latin(name).encode("cp1252")
