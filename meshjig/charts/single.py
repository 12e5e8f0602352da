"""One chart for a whole component: its surface cut open along a tree, or a graph where it has handles."""

from meshjig.charts.chart import Chart, Charting
from meshjig.charts.segment.segment import segment
from meshjig.charts.segmented import own_charts
from meshjig.charts.zip.zip import zip_charts
from meshjig.errors import ChartError
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Floats, Ints

__all__ = ["single_chart"]

_SHARES = (0.985, 0.95, 0.9, 0.8)  # of the area within FLAT_LIMITS, the best first; less is hopeless
_EFFORT = 40_000  # faces flattened, for each of them


def single_chart(V: Floats, F: Ints, light: tuple[Floats, Ints], seed: int = 0) -> Charting:
    """Cut a component open so that it is one disc, and flatten it by SLIM.

    The cuts are what is left of the seams between few flat regions after these were glued to one: they
    pass through tips and creases, where a cut takes most stretch away.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, manifold, one component
    light : (V, F) of its proxy
    seed : int

    Returns
    -------
    Charting

    Raises
    ------
    ChartError
        The component would stretch too much, or lie on itself.
    """
    label = segment(*light, seed=seed)
    made = own_charts(V, F, light, label, "slim", seed=seed, zipped=_glued_to_one)
    if len(made.charts) == 1:
        return Charting(made.charts, "single", made.leaf)
    area = face_areas(V, F)
    largest = max(float(area[chart.faces].sum() / area.sum()) for chart in made.charts)
    raise ChartError(
        f"one chart of {len(F)} faces would lie on itself, or stretch more than {1 - _SHARES[-1]:.0%} of its "
        f"area by more than a fifth; {len(made.charts)} charts are left, the largest with {largest:.0%}",
        hint="use --charts auto",
    )


def _glued_to_one(V: Floats, F: Ints, leaves: list[Chart]) -> list[Chart]:
    """Glue charts to one, at the least stretch first; to a few where that fails."""
    return zip_charts(V, F, leaves, _SHARES, _EFFORT)
