"""Series of files that other programs, and this one, have written."""
