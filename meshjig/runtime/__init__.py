"""Processes, signals and limits: what a run needs of the machine."""
