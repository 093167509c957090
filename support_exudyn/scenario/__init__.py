"""What determines a run, and whether it fits together."""
