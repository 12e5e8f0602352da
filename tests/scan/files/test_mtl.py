"""Files of materials, as programs write them."""

import numpy as np

from meshjig.scan.files.mtl import Picture, parse_mtl


def test_colours_and_pictures_by_names_with_blanks():
    text = "newmtl dark wood\n\tKd 0.5 .25 1e-1\n\tKa 0 0 0\nmap_Kd old wood.png\n\n"
    text += "NEWMTL b\nkd 1\nmap_Ka c.jpg\n"
    found = parse_mtl(text.replace("\n", "\r\n").encode())
    assert found["dark wood"].colour == (0.5, 0.25, 0.1)
    assert found["dark wood"].picture == Picture("old wood.png")
    assert found["b"].colour == (1, 1, 1)
    assert found["b"].picture == Picture("c.jpg")


def test_options_before_the_name():
    for line, wanted in [
        ("-s 2 3 1 -o 0.5 0 0 a b.png", Picture("a b.png", (2, 3), (0.5, 0))),
        ("-clamp on -s 4 a.png", Picture("a.png", (4, 1), (0, 0), True)),
        ("-blendu off -mm 0 1 -texres 512 -bm 0.4 -imfchan r a.png", Picture("a.png")),
        ("-t 1 1 1 -type sphere a.png", Picture("a.png")),
        ('"quoted name.png"', Picture("quoted name.png")),
        ("-odd-name.png", Picture("-odd-name.png")),
        ("-s 1 1 1 7.png", Picture("7.png")),
    ]:
        assert parse_mtl(f"newmtl a\nmap_Kd {line}\n".encode())["a"].picture == wanted, line


def test_nonsense_is_left_out():
    assert parse_mtl(b"Kd 1 1 1\nnewmtl a\nKd spectral x.rfl\nmap_Kd\nmap_Kd -s 2\n")["a"].colour is None
    assert parse_mtl(bytes(range(256))) == {}


def test_a_place_in_the_picture():
    uv = np.array([[0.0, 0.5], [1.5, 1.0]])
    assert Picture("a").place(uv) is uv
    assert Picture("a", (2, 1), (0.5, 0)).place(uv).tolist() == [[0.5, 0.5], [3.5, 1.0]]
    assert Picture("a", clamp=True).place(uv).tolist() == [[0, 0.5], [1, 1]]
