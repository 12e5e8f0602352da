"""What makes a puzzle easier to build: labels on its pieces, and a core to build it on."""

from meshjig.extras.core import CoreShape, make_core
from meshjig.extras.engrave import LETTERING, Lettering, engrave
from meshjig.extras.label_ground import LabelGround, label_grounds
from meshjig.extras.text import text_outline

__all__ = [
    "LETTERING",
    "CoreShape",
    "LabelGround",
    "Lettering",
    "engrave",
    "label_grounds",
    "make_core",
    "text_outline",
]
