"""What acts on a machine besides its weight, one kind a file."""
