"""What makes a puzzle easier to build: labels on its pieces, and a core to build it on."""

from meshjig.finish.core import make_core
from meshjig.finish.engrave import LETTERING, Lettering, engrave
from meshjig.finish.text import text_outline

__all__ = ["LETTERING", "Lettering", "engrave", "make_core", "text_outline"]
