"""Every promise as a predicate on finished pieces, independent of how they were made."""

from meshjig.check.areas import area_cv, area_error
from meshjig.check.assembly import AssemblyChecks, AssemblyPlan, judge_assembly
from meshjig.check.closed import as_stl, is_closed, is_closed_as_stl, is_one_component, volume
from meshjig.check.core import CoreChecks, add_failures, judge_core
from meshjig.check.gap import Gap, gaps
from meshjig.check.judge import Verdict, judge
from meshjig.check.overlap import Overlaps, overlaps
from meshjig.check.self_intersection import crossing_depth, self_intersections
from meshjig.check.thickness import Thickness, measure_thickness
from meshjig.check.thin_parts import ThinParts

__all__ = [
    "AssemblyChecks",
    "AssemblyPlan",
    "CoreChecks",
    "Gap",
    "Overlaps",
    "Thickness",
    "ThinParts",
    "Verdict",
    "add_failures",
    "area_cv",
    "area_error",
    "as_stl",
    "crossing_depth",
    "gaps",
    "is_closed",
    "is_closed_as_stl",
    "is_one_component",
    "judge",
    "judge_assembly",
    "judge_core",
    "measure_thickness",
    "overlaps",
    "self_intersections",
    "volume",
]
