"""Scenes with more and fewer elements of the model, what is measured of them, and tables."""
