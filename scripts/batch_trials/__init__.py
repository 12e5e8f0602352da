"""Trials of meshjig batch that take minutes: scripts/batch_trials.py runs them."""
