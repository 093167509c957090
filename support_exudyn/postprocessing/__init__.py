"""What is made of a finished run: figures, frames, movies, the viewer, files for other programs, a summary."""
