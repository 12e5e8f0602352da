"""Parts that came off of pieces join a neighbour, or become pieces."""

import numpy as np
import trimesh

from meshjig.layout.cells import cell_layout
from meshjig.layout.part_off import part_off
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.runtime.progress import Stages


def layout_of_a_ball():
    ball = trimesh.creation.icosphere(4, 20.0)
    mesh = Mesh(np.asarray(ball.vertices, float), np.asarray(ball.faces, np.int64))
    return cell_layout(mesh, Options.of(pieces=8), Stages(None))


def test_a_large_part_becomes_a_piece_and_a_small_one_joins() -> None:
    layout = layout_of_a_ball()
    piece, area = layout.piece_of_face, face_areas(layout.cut.V, layout.cut.F)
    z = layout.cut.V[layout.cut.F].mean(axis=1)[:, 2]
    own = piece == 0
    half = own & (z > np.median(z[own]))
    parted = part_off(layout, [half], 0.25)
    assert parted.stitching.n_pieces == 9
    assert (parted.piece_of_face[half] == 8).all()
    assert (parted.piece_of_face[~half] == piece[~half]).all()
    assert parted.stitching.facts.parted == 1

    joined = part_off(layout, [half], 0.9)
    assert joined.stitching.n_pieces == 8
    assert joined.stitching.facts.handed_over == 1
    to = np.unique(joined.piece_of_face[half])
    assert len(to) == 1
    assert to[0] != 0
    assert np.isclose(
        area[joined.piece_of_face == to[0]].sum(), area[piece == to[0]].sum() + area[half].sum()
    )
