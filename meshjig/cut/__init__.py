"""Cut a surface along planar outlines, exactly and conformingly."""

from meshjig.cut.overlay import overlay

__all__ = ["overlay"]
