"""Hypothesis strategies: small meshes by topology and noise."""

from hypothesis import strategies as st

from tests.meshes import (
    Shape,
    closed_cylinder,
    creased_box,
    cylinder,
    genus2,
    half_sphere,
    noisy,
    open_cup,
    saddle,
    sphere,
    torus,
    two_components,
)

__all__ = ["CLOSED", "OPEN", "meshes"]

CLOSED = (sphere, torus, genus2, creased_box, closed_cylinder)
OPEN = (open_cup, cylinder, half_sphere, saddle)


def meshes(
    makers: tuple = (*CLOSED, *OPEN, two_components), faces: tuple[int, int] = (100, 2000), noise: float = 0.1
) -> st.SearchStrategy[Shape]:
    """Draw a mesh: its topology from makers, its number of faces from a range, its noise in edge lengths."""
    return st.builds(
        lambda maker, n, amount, seed: noisy(maker(n), amount, seed),
        st.sampled_from(makers),
        st.integers(*faces),
        st.sampled_from([0.0, noise / 2, noise]),
        st.integers(0, 2**16),
    )
