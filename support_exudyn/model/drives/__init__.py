"""How driven parts move, one kind a file."""
