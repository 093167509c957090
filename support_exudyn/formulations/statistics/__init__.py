"""Statistics of channels from every step of a solver."""
