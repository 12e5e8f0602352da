"""From how many faces on work is worth a child process; below, that takes longer to start than it saves."""

__all__ = ["CHARTS_WORTH_A_CHILD", "FILES_WORTH_A_CHILD", "SOLIDS_WORTH_A_CHILD"]

CHARTS_WORTH_A_CHILD = 4_000  # faces of the surface: charts that are tried
SOLIDS_WORTH_A_CHILD = 20_000  # faces of the surface: its two sheets, and the gap
FILES_WORTH_A_CHILD = 60_000  # faces of all pieces: their verdict, and their pictures
