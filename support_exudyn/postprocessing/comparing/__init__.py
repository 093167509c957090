"""How far two curves, or two runs, are apart, and whether that is more than their errors or chance explain."""
