"""What scripts/thin_trial.py measures, for tests."""

import sys

from tests.docs.blocks import ROOT

__all__ = ["Model", "lost_volume", "thin_share", "uncovered"]

sys.path.insert(0, str(ROOT / "scripts"))
try:
    from thin.cover import lost_volume, uncovered
    from thin.model import Model
    from thin.walls import thin_share
finally:
    sys.path.pop(0)
