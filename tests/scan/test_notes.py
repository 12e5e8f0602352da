"""What repair has taken away, and what stays open, is said; and what is advised there works."""

import re

import numpy as np
import pytest

from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import compact
from meshjig.scan import repair
from meshjig.scan.fill import fill_holes
from meshjig.scan.loss import loss
from meshjig.scan.notes import open_borders_note, repair_notes
from tests.meshes import Shape, cavity_shell, cylinder, disc, joined, moved, sphere, torus


def with_holes(mesh, *radii):
    """Leave out faces around points of a sphere, each within a radius of it, mm."""
    centre = mesh.V[mesh.F].mean(1)
    at = 50 * np.array([[0, 0, 1], [0, 0, -1], [0, 1, 0], [0, -1, 0]])[: len(radii)]
    near = [np.linalg.norm(centre - p, axis=1) < r for p, r in zip(at, radii, strict=True)]
    F, kept = compact(mesh.F[~np.any(near, axis=0)])
    return Shape(mesh.V[kept], F)


def test_much_that_repair_takes_away_is_said():
    twice = sphere(320)
    changes = repair(twice.V, np.concatenate([twice.F, twice.F])).changes
    assert repair_notes(changes) == [
        "repair took away 50% of the faces and 50% of the area: 320 faces that came twice"
    ]
    assert (
        "hollows inside the solid (--cavities keeps them)"
        in repair_notes(repair(*cavity_shell(1000)).changes)[0]
    )
    assert repair_notes(repair(*twice).changes) == []


def test_loss_is_the_share_of_what_is_gone():
    mesh = sphere(320)
    assert loss(mesh, (mesh.V, mesh.F[:80])).faces == 0.75
    assert loss(mesh, (mesh.V, mesh.F[:80])).area == pytest.approx(0.75, abs=0.05)
    assert loss((mesh.V, mesh.F[:80]), mesh) == (0, 0)
    assert loss(mesh, mesh).much is False


def test_holes_that_stay_open_are_named_and_the_advice_closes_them():
    V, F = with_holes(sphere(5000), 20, 10, 5, 5)
    filled = fill_holes(V, F, 14.0)
    (note,) = open_borders_note(filled.facts)
    assert re.match(r"2 holes stay open: (\S+) mm wide around \(0, 0, \d\d\) mm; ", note)
    assert 40 < float(re.search(r"open: (\S+) mm", note)[1]) < 44
    advised = float(re.search(r"--fill-holes (\d+) closes them", note)[1])
    assert not border_loops(fill_holes(V, F, advised).F)
    assert open_borders_note(fill_holes(V, F, advised).facts) == []


def test_a_ragged_hole_is_closed_with_the_diameter_that_is_advised():
    mesh = torus(3000)
    ragged = (np.arange(len(mesh.F)) % 2 == 0) & (mesh.V[mesh.F].mean(1)[:, 0] > 20)
    F = mesh.F[~ragged]
    component = components(F)[1]
    F, origin = fans(F[component == np.bincount(component).argmax()])
    filled = fill_holes(mesh.V[origin], F, 1.0)
    for note in open_borders_note(filled.facts):
        advised = re.search(r"--fill-holes (\d+)", note)
        if advised:
            again = fill_holes(mesh.V[origin], F, float(advised[1]))
            assert again.facts.left < filled.facts.left


def test_the_rim_of_a_scrap_is_not_advised_to_be_closed():
    scrap = joined(sphere(1000), moved(disc(50), (200, 0, 0)))
    (note,) = open_borders_note(fill_holes(*scrap, 1.0).facts)
    assert note.startswith("1 hole stays open")
    assert "--fill-holes" not in note


def test_borders_that_are_to_stay_are_neither_closed_nor_named():
    V, F = cylinder(1000)
    filled = fill_holes(V, F, 500.0, V[:, 2] < V[:, 2].min() + 1)
    assert (filled.facts.closed, filled.facts.left, filled.facts.open) == (1, 1, [])
