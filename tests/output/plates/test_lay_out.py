"""What fits a plate in no pose that it would rest in by itself is laid along the axes."""

from meshjig.output.piece import Piece
from meshjig.output.plates.lay_out import lay_out
from meshjig.output.plates.printers import Plate
from tests.meshes import creased_box

BOX = creased_box(48)  # 100 mm
TALL = Piece("core_1", BOX.V * [1.0, 1.0, 1.5], BOX.F, (0.5, 0.5, 0.5))


def test_a_block_stands_where_it_fits_no_other_way():
    placed, left_out = lay_out([TALL], Plate(115.0, 115.0, 160.0))
    assert not left_out
    assert placed[0].pose.height == 150.0


def test_a_block_lies_where_it_can():
    placed, _ = lay_out([TALL], Plate(170.0, 170.0, 160.0))
    assert placed[0].pose.height == 100.0
