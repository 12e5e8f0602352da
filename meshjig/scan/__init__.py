"""From a file to a clean mesh in mm: load, repair, scale, working resolution."""

from meshjig.mesh.intersections import self_crossings
from meshjig.scan.load import load
from meshjig.scan.preparation import Floor, Preparation
from meshjig.scan.read import Scan, ScanFacts, describe, read_scan
from meshjig.scan.repair import repair
from meshjig.scan.resurface import resurface
from meshjig.scan.scale import decimate, to_millimetres

__all__ = [
    "Floor",
    "Preparation",
    "Scan",
    "ScanFacts",
    "decimate",
    "describe",
    "load",
    "read_scan",
    "repair",
    "resurface",
    "self_crossings",
    "to_millimetres",
]
