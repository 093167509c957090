"""Scripts to read, to copy and to change; each writes a picture with its own name where it is run."""
