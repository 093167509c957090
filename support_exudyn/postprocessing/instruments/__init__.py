"""What instruments on a machine read of a run: pressures, extensions and tilts, sampled, filtered, noisy."""
