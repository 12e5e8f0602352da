"""A solid by Boolean operations: a swept base, an upright disc, a hyperbolic hole, an extruded cut."""

import numpy as np
import trimesh

__all__ = ["bridge"]


def bridge(step: float = 2.2) -> trimesh.Trimesh:
    """Build it of four surfaces that meet in creases; closed, 150 mm long; y is up."""
    from manifold3d import CrossSection, Manifold

    base = _bar(150, 56, 44)
    disc = Manifold.revolve(CrossSection([_rim(46, 18, 6)]), 240).translate([0, 76, 0])
    t = np.linspace(-40, 40, 60)
    radius = np.sqrt(15**2 + (0.75 * t) ** 2)
    half = np.vstack([[[0, -40]], np.stack([radius, t], 1), [[0, 40]]])
    hole = Manifold.revolve(CrossSection([half]), 200).translate([0, 76, 0])
    arch = np.stack([26 * np.cos(np.linspace(0, np.pi, 90)), 26 * np.sin(np.linspace(0, np.pi, 90))], 1)
    gate = np.vstack([[[26, -10]], arch, [[-26, -10]]])
    cut = Manifold.extrude(CrossSection([gate]), 120).translate([0, 0, -60])
    mesh = (base + disc - hole - cut).refine_to_length(step).to_mesh()
    return trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts, process=False)


def _rim(radius: float, thick: float, soft: float) -> np.ndarray:
    """Half the outline of a disc on edge, its corners rounded; (distance from the axis, along it)."""
    a = np.linspace(-np.pi / 2, 0, 16)
    corner = np.stack([radius - soft + soft * np.cos(a), -thick + soft + soft * np.sin(a)], 1)
    other = corner[::-1] * (1, -1)
    return np.vstack([[[0, -thick]], corner, other, [[0, thick]]])


def _bar(length: float, height: float, depth: float):
    """Sweep a rounded outline along a straight line and round its ends."""
    from manifold3d import CrossSection, Manifold

    r = 12.0
    inner = CrossSection.square([length - 2 * r, depth - 2 * r], True).offset(r, circular_segments=96)
    return Manifold.extrude(inner, height).rotate([-90, 0, 0])
