"""What is made of a finished run: figures, frames and movies, the viewer, files for other programs, a summary."""
