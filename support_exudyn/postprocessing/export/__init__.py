"""What is written for other programs; the entry is `postprocessing.export.export`."""
