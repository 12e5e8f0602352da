"""What scripts/thin_trial.py measures."""
